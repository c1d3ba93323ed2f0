#include "app/cli/study_worlds.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/resource.h"
#include "core/base/table.h"
#include "core/base/yaml.h"
#include "core/experiments/software.h"
#include "core/experiments/world_study.h"
#include "core/stats/proportion.h"

namespace capstan::cli {
namespace {

using experiments::Method;
using experiments::Recovery;
using experiments::WorldStudy;
using experiments::WorldStudyOptions;

constexpr double kCoverageGoal = 0.9;

base::Table tableOf(const WorldStudy& study, const WorldStudyOptions& options) {
  base::Table table;
  table.title = fmt::format("Known truth recovered in {} worlds, {:g} s of block transfer each",
                            study.worlds.size(), options.duration);
  table.columns = {{"parameter", {}, 0}, {"method", {}, 0},         {"inside 95 % interval", {}, 0},
                   {"of", {}, 0},        {"coverage, 95 %", {}, 0}, {"goal 90 %", {}, 0},
                   {"seen in", {}, 0},   {"median error", "%", 3},  {"median half-width", "%", 3}};
  for (std::size_t i = 0; i < study.names.size(); ++i)
    for (const Method method : {Method::kDualUkf, Method::kBatch}) {
      const Recovery r = study.recovery(i, method);
      const auto interval = stats::wilsonInterval(r.covered, r.worlds);
      table.rows.push_back({study.names[i], method == Method::kDualUkf ? "dual UKF" : "batch",
                            static_cast<double>(r.covered), static_cast<double>(r.worlds),
                            fmt::format("{:.0f}–{:.0f} %", 100.0 * interval.low, 100.0 * interval.high),
                            r.covered >= kCoverageGoal * r.worlds ? "met" : "not met",
                            static_cast<double>(r.seen), 100.0 * r.median_error,
                            100.0 * r.median_half_width});
    }
  table.note =
      "Simulated robots. Seen: the recording at least halved what was unknown before; errors and half-widths "
      "of the interval are of those.";
  return table;
}

nlohmann::json jsonOf(const WorldStudy& study, const WorldStudyOptions& options) {
  nlohmann::json worlds = nlohmann::json::array();
  for (const auto& world : study.worlds) {
    nlohmann::json one = {{"seed", world.seed}, {"seconds", world.seconds}};
    for (std::size_t i = 0; i < study.names.size(); ++i) {
      const auto& estimate = world.parameters[i];
      one["parameters"][study.names[i]] = {{"truth", estimate.truth},
                                           {"value", estimate.value},
                                           {"low", estimate.low},
                                           {"high", estimate.high},
                                           {"seen", estimate.seen}};
    }
    worlds.push_back(one);
  }
  return {{"methods", {"dual UKF", "batch"}},
          {"duration", options.duration},
          {"pixel_sigma", options.pixel_sigma},
          {"software", options.software},
          {"worlds", worlds}};
}

ExitCode run(WorldStudyOptions& options, const std::string& json) {
  checkOutputs({{"--json", json}}, {});
  if (!options.out.empty()) checkOutputFolder("--out", options.out.string(), {}, {});
  const Output output(json);
  base::Progress progress;
  WorldStudy study;
  {
    const ProgressLine line(progress);
    study = experiments::runWorldStudy(options, progress);
  }
  for (const std::string& text : study.notices) notice(text);
  if (study.worlds.empty()) {
    notice("cancelled before the first world was done");
    return kFailed;
  }
  const base::Table table = tableOf(study, options);
  output.text(base::markdownOf(table));
  output.json(jsonOf(study, options));
  if (!options.out.empty()) {
    base::writeTextFile(options.out / "worlds.md", base::markdownOf(table));
    base::writeTextFile(options.out / "worlds.csv", base::csvOf(table));
  }
  if (study.cancelled) notice("cancelled: the table holds the worlds that were done");
  return study.cancelled ? kFailed : kOk;
}

}  // namespace

void addWorldStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<WorldStudyOptions>();
  auto json = std::make_shared<std::string>();
  options->truth = base::resource("truth/laboratory.yaml");
  options->trajectory = base::resource("experiments/fls.yaml");
  options->software = experiments::software();
  CLI::App* command = study.add_subcommand(
      "worlds", "Coverage and error of identified parameters in simulated robots drawn at random");
  command->add_option("--count", options->worlds, "worlds")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  command->add_option("--duration", options->duration, "of each recording [s]")
      ->capture_default_str()
      ->check(CLI::Range(20.0, 3600.0));
  command->add_option("--seed", options->seed, "of the first world; the next has the next")
      ->capture_default_str();
  command->add_option("--parameters", options->parameters, "as in identify")->capture_default_str();
  command->add_option("--truth", options->truth, "truth file that worlds are drawn around")
      ->check(CLI::ExistingFile);
  command->add_option("--pixel-sigma", options->pixel_sigma, "noise of a marker's position [px]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--threads", options->threads, "worlds at the same time")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--out", options->out, "folder that keeps finished worlds and the table");
  command->add_option("--json", *json, "result as JSON, SI: a file, or - for standard output");
  command->footer(
      "A world takes about half a minute of one core. Examples:\n"
      "  capstan-cli study worlds --out worlds          # goes on where it was stopped\n"
      "  capstan-cli study worlds --count 10 --duration 60");
  command->callback([options, json, &exit] { exit = run(*options, *json); });
}

}  // namespace capstan::cli
