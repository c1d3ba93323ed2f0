// learning_study DATA [--splits 10] [--parts table,process,curve,latency]
// [--towards robot,command] [--out DIR]: what the GPR paper
// shows of its recording, on the same recording (a table of tip poses), beside the paper's numbers and beside
// scikit-learn's process on the same states (python3-sklearn; without it those columns are excluded).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/base/error.h"
#include "tests/support/learning_study/latency.h"
#include "tests/support/learning_study/process_race.h"
#include "tests/support/learning_study/split_race.h"
#include "tests/support/learning_study/training_sizes.h"

int main(int argc, char** argv) {
  using namespace capstan;
  study::LearningStudyOptions options;
  std::vector<std::string> parts = {"table", "process", "curve", "latency"};
  CLI::App app("The GPR paper's tables and figures on a recording of tip poses");
  app.add_option("DATA", options.data, "table of tip poses")->required()->check(CLI::ExistingFile);
  app.add_option("--splits", options.splits, "by trajectory")->check(CLI::Range(1, 100));
  app.add_option("--parts", parts, "table, process, curve, latency")
      ->delimiter(',')
      ->check(CLI::IsMember({"table", "process", "curve", "latency"}));
  app.add_option("--towards", options.towards, "of table: robot, command")
      ->delimiter(',')
      ->check(CLI::IsMember({"robot", "command"}));
  app.add_option("--members", options.correction.members, "processes averaged")->check(CLI::Range(1, 20));
  app.add_option("--inducing", options.correction.inducing_points)->check(CLI::Range(20, 20000));
  app.add_option("--threads", options.correction.threads)->check(CLI::Range(1, 64));
  app.add_option("--seed", options.seed);
  app.add_option("--out", options.folder, "of what scikit-learn reads; it stays");
  CLI11_PARSE(app, argc, argv);
  try {
    const study::LearningData data = study::readLearningData(options);
    for (const std::string& part : parts) {
      if (part == "table") study::raceSplits(data, options);
      if (part == "process") study::raceProcesses(data, options);
      if (part == "curve") study::tellTrainingSizes(data, options);
      if (part == "latency") study::tellLatency(data, options);
      std::fflush(stdout);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "learning_study: %s\n", error.what());
    return 1;
  }
}
