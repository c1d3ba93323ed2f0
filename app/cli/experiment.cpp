#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/experiment_correction.h"
#include "app/cli/experiment_output.h"
#include "app/cli/outputs.h"
#include "app/cli/shard_option.h"
#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/experiments/comparison.h"
#include "core/experiments/published.h"
#include "core/experiments/run.h"
#include "core/experiments/tables.h"

namespace capstan::cli {
namespace {

using experiments::Results;
using experiments::Specification;

struct ExperimentArguments {
  std::string name, out = "capstan-experiments", json;
  int threads = 2;
  std::optional<bool> images;
  ShardArguments shard;
  CorrectionExperimentArguments correction;
};

std::vector<Specification> specificationsOf(const std::string& name) {
  const auto suffix = std::filesystem::path(name).extension();
  if (suffix == ".yaml" || suffix == ".yml") return {experiments::readSpecification(name)};
  if (name != "all") return {experiments::findSpecification(name)};
  std::vector<Specification> all;
  for (const char* one : {"A", "B", "C", "D"}) all.push_back(experiments::findSpecification(one));
  return all;
}

/// Runs the experiments one after the other, each with a line of progress. Returns false if cancelled.
bool runAll(const std::vector<Specification>& specifications, const experiments::RunOptions& options,
            std::vector<Results>& done) {
  for (const Specification& specification : specifications) {
    base::Progress progress;
    Results results;
    {
      const ProgressLine line(progress);
      results = experiments::run(specification, options, progress);
    }
    for (const std::string& text : results.notices) notice(text);
    const bool cancelled = results.cancelled;
    done.push_back(std::move(results));
    if (cancelled) return false;
  }
  return true;
}

ExitCode experiment(ExperimentArguments& arguments) {
  if (isCorrectionExperiment(arguments.name) && !arguments.shard.shard.empty())
    refuseOption(
        "--shard", arguments.shard.shard,
        "is not for experiment " + arguments.name + ", which is one computation over all of its data",
        "Run it without --shard; --threads uses more cores");
  if (isCorrectionExperiment(arguments.name))
    return runCorrectionExperiment(arguments.name, arguments.out, arguments.json, arguments.threads,
                                   arguments.correction);
  if (!arguments.correction.options.poses.empty())
    refuseFile(arguments.correction.options.poses.front(), "is not for experiment " + arguments.name,
               "Tables of tip poses are for E and F");
  const std::vector<Specification> specifications = specificationsOf(arguments.name);
  checkOutputFolder("--out", arguments.out, {}, {});
  checkOutputs({{"--json", arguments.json}}, {});
  ShardRun shard(arguments.shard, arguments.out, {{"--json", arguments.json}});
  const Output output(arguments.json);
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Results> done;
  const bool finished = runAll(specifications,
                               {.out = arguments.out,
                                .threads = arguments.threads,
                                .images = arguments.images,
                                .software = base::software(),
                                .part = shard.part()},
                               done);
  if (!finished) {
    notice(cancelledText(done, arguments.out));
    return kFailed;
  }
  if (shard.isShard()) {
    output.text(shard.finish());
    return kOk;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const experiments::Published published = experiments::readPublished();
  const std::string page = experiments::comparisonPage(done, published);
  const auto file = std::filesystem::path(arguments.out) /
                    (arguments.name == "all" ? "comparison.md" : done.front().name + "/comparison.md");
  base::writeTextFile(file, page);
  for (const Results& results : done)
    experiments::writeTables(experiments::tablesOf(results, experiments::paperBeside(results, published)),
                             std::filesystem::path(arguments.out) / results.name);
  output.text(page + timesText(done, seconds) + fmt::format("written to {}\n", file.string()));
  output.json(jsonOf(done, published));
  return kOk;
}

}  // namespace

void addExperiment(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<ExperimentArguments>();
  CLI::App* command = app.add_subcommand("experiment",
                                         "Run experiments of Haghighipanah et al. (the UKF paper: A to D), "
                                         "of Mahler et al. (the GPR paper: E to H),\n"
                                         "or of a specification, and compare the results with the paper");
  command
      ->add_option("NAME", arguments->name,
                   "A (pulley radius), B (cables), C (errors), D (occlusion), all (A to D), or a "
                   "specification (.yaml);\n"
                   "E (errors of corrected poses), F (training size), G (arrival), H (debridement)")
      ->required();
  command->add_option("--out", arguments->out, "folder of results; finished trials in it are not run again")
      ->capture_default_str();
  command->add_option("--threads", arguments->threads, "number of trials that run in parallel")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  addShardOption(*command, arguments->shard, "trials");
  command->add_flag_callback(
      "--images", [arguments] { arguments->images = true; },
      "render images, even if the specification excludes them");
  command->add_flag_callback(
      "--no-images", [arguments] { arguments->images = false; },
      "tip positions with pixel noise instead of images: faster");
  addCorrectionOptions(*command, arguments->correction);
  command->add_option("--json", arguments->json,
                      "numbers and goals as JSON, SI: a file, or - for standard output");
  command->footer(
      "Ctrl-C stops the run; the same command continues it. C and D run A and B first and use the robot\n"
      "that these identify. resources/experiments holds A.yaml … D.yaml to copy from. Examples:\n"
      "  capstan-cli experiment all --out results\n"
      "  capstan-cli experiment C --no-images --json -\n"
      "  capstan-cli experiment D --shard 2/8 --out part-2       (one of 8 parts, for `merge`)\n"
      "  capstan-cli experiment my_trials.yaml --out results     (simulated, or recorded sessions)\n"
      "  capstan-cli experiment E poses.csv --towards robot      (a table of tip poses, as learn takes it)\n"
      "  capstan-cli experiment H --fragments 20");
  command->callback([arguments, &exit] { exit = experiment(*arguments); });
}

}  // namespace capstan::cli
