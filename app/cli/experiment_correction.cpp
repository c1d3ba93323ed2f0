#include "app/cli/experiment_correction.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/cli/console.h"
#include "app/cli/file_drawing.h"
#include "app/cli/outputs.h"
#include "core/base/software.h"
#include "widgets/figures/correction_experiment_figures.h"

namespace capstan::cli {
namespace {

constexpr const char* kGroup = "Experiments E to H";

experiments::CorrectionExperimentResults computed(const experiments::CorrectionExperimentOptions& options) {
  base::Progress progress;
  const ProgressLine line(progress);
  return experiments::runCorrectionExperiment(options, progress);
}

}  // namespace

void addCorrectionOptions(CLI::App& command, CorrectionExperimentArguments& arguments) {
  experiments::CorrectionExperimentOptions& options = arguments.options;
  const auto grouped = [](CLI::Option* option) { return option->group(kGroup); };
  grouped(command.add_option("POSES,--poses", options.poses, "tables of tip poses, for E and F"));
  grouped(
      command.add_option(
          "--towards", arguments.towards,
          "poses that the observed poses are compared with: commands or the robot's kinematics, for E and F"))
      ->capture_default_str()
      ->check(CLI::IsMember({"command", "robot"}));
  grouped(command.add_option("--splits", options.errors.splits,
                             "number of random splits into training and test set, for E"))
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  grouped(command.add_option("--motions", options.simulated.training.motions,
                             "number of training motions, for G and H"))
      ->capture_default_str()
      ->check(CLI::Range(10, 100000));
  grouped(command.add_option("--arrivals", options.simulated.arrival.repetitions,
                             "number of arrivals per location, for G"))
      ->capture_default_str()
      ->check(CLI::Range(2, 10000));
  grouped(command.add_option("--fragments", options.simulated.task.fragments,
                             "number of fragments per method, for H"))
      ->capture_default_str()
      ->check(CLI::Range(2, 100000));
  grouped(command.add_option("--inducing", options.errors.correction.inducing_points,
                             "number of inducing points per process"))
      ->capture_default_str()
      ->check(CLI::Range(20, 20000));
  grouped(command.add_option("--seed", options.errors.seed, "random seed of splits, motions and noise"))
      ->capture_default_str();
}

bool isCorrectionExperiment(const std::string& name) {
  return base::fromName<experiments::CorrectionExperiment>(name).has_value();
}

ExitCode runCorrectionExperiment(const std::string& name, const std::string& out, const std::string& json,
                                 int threads, CorrectionExperimentArguments& arguments) {
  experiments::CorrectionExperimentOptions& options = arguments.options;
  options.experiment = *base::fromName<experiments::CorrectionExperiment>(name);
  options.towards =
      arguments.towards == "command" ? learning::StreamKind::kCommand : learning::StreamKind::kRobot;
  options.training_size.correction = options.errors.correction;
  options.simulated.training.correction.inducing_points = options.errors.correction.inducing_points;
  options.training_size.seed = options.simulated.seed = options.errors.seed;
  options.errors.correction.threads = options.training_size.correction.threads = options.simulated.threads =
      threads;
  const std::filesystem::path folder = std::filesystem::path(out) / name;
  checkOutputFolder("--out", out, {}, options.poses);
  checkOutputs({{"--json", json}}, options.poses);
  const Output output(json);
  const experiments::CorrectionExperimentResults results = computed(options);
  if (results.cancelled) {
    notice("cancelled: nothing is written");
    return kFailed;
  }
  const FileDrawing drawing;
  widgets::writeExperiment(results, folder);
  output.text(comparisonPage(results, base::software()) +
              fmt::format("written to {}\n", (folder / "comparison.md").string()));
  output.json(jsonOf(results));
  return kOk;
}

}  // namespace capstan::cli
