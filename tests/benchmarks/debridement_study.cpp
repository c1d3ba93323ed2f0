// debridement_study [--seed 1] [--threads 2] [--fragments 100] …: trains the command correction on the
// simulated seven-joint arm, lets it arrive at fragments and clear them, and prints both tables beside the
// GPR paper's (section V, table II); some minutes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <exception>

#include "core/experiments/debridement_study.h"

int main(int argc, char** argv) {
  using namespace capstan;
  experiments::DebridementStudyOptions options;
  CLI::App app("Command correction and debridement on the simulated seven-joint arm");
  app.add_option("--robot", options.robot, "robot file; unset: raven2_left_tool.yaml");
  app.add_option("--truth", options.truth, "what the arm really is; unset: debridement.yaml");
  app.add_option("--motions", options.training.motions, "recorded for training");
  app.add_option("--learned-from", options.training.correction.likelihood_points,
                 "states that hyperparameters are learned from");
  app.add_option("--inducing", options.training.correction.inducing_points,
                 "points of the learned correction");
  app.add_option("--locations", options.arrival.locations, "of table II");
  app.add_option("--visits", options.arrival.visits, "of each location");
  app.add_option("--fragments", options.task.fragments, "of each method");
  app.add_option("--fragments-beyond", options.fragments_beyond, "likewise, beside the data");
  app.add_option("--beyond", options.beyond, "how far beside [m]");
  app.add_option("--capture", options.task.capture, "of the jaws [m]");
  app.add_option("--piece", options.task.piece, "that replanning moves between looks [m]");
  app.add_option("--seed", options.seed, "of motions, noise, locations and fragments");
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  try {
    const auto begin = std::chrono::steady_clock::now();
    base::Progress progress;
    const experiments::DebridementStudyReport report = experiments::runDebridementStudy(options, progress);
    for (const base::Table& table :
         {experiments::trainingTable(report), experiments::arrivalTable(report),
          experiments::debridementTable(report, options), experiments::beyondTable(report, options)})
      std::puts(base::markdownOf(table).c_str());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::fprintf(stderr, "%.0f s\n", took.count());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "debridement_study: %s\n", error.what());
    return 1;
  }
}
