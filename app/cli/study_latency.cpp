#include "app/cli/study_latency.h"

#include <memory>
#include <string>

#include "app/cli/study_frame.h"
#include "core/base/table.h"
#include "core/studies/latency_study.h"

namespace capstan::cli {
namespace {

using studies::LatencyStudy;
using studies::LatencyStudyOptions;

nlohmann::json rmsJson(const std::array<Eigen::Vector3d, 3>& rms) {
  return {{"as_stamped", toJson(rms[0])}, {"corrected", toJson(rms[1])}, {"true_delay", toJson(rms[2])}};
}

nlohmann::json documentOf(const LatencyStudy& study, const LatencyStudyOptions& options) {
  nlohmann::json trials = nlohmann::json::array();
  for (const auto& trial : study.trials)
    trials.push_back({{"truth", trial.truth},
                      {"seed", trial.seed},
                      {"dual_ukf", {{"delay", trial.delay[0]}, {"sigma", trial.sigma[0]}}},
                      {"batch", {{"delay", trial.delay[1]}, {"sigma", trial.sigma[1]}}},
                      {"rms",
                       {{"ukf", rmsJson(trial.rms[0])},
                        {"camera", rmsJson(trial.rms[1])},
                        {"ukf_without_motors", rmsJson(trial.rms[2])}}}});
  return {{"duration", options.duration},
          {"prior_sigma", options.prior_sigma},
          {"parameters", options.parameters},
          {"robot_truth", options.truth},
          {"trials", trials}};
}

ExitCode run(LatencyStudyOptions& options, const StudyArguments& arguments) {
  checkStudyOutputs(arguments, "latency", {}, {options.truth});
  if (!arguments.out.empty()) options.out = std::filesystem::path(arguments.out) / "recordings";
  return runStudy(
      arguments, "latency",
      [&](base::Progress& progress, experiments::PartialRun* part) {
        options.part = part;
        return studies::runLatencyStudy(options, progress);
      },
      [](const LatencyStudy&) { return false; },
      [&](const LatencyStudy& study) {
        const base::Table estimates = studies::estimatesOf(study, options),
                          gain = studies::gainOf(study, options);
        return StudyReport{
            base::markdownOf(estimates) + "\n" + base::markdownOf(gain),
            documentOf(study, options),
            {{"latency-estimates.csv", base::csvOf(estimates)}, {"latency-errors.csv", base::csvOf(gain)}}};
      });
}

}  // namespace

void addLatencyStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<LatencyStudyOptions>();
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand("latency",
                                           "Compare the identified delay of the camera's clock with the true "
                                           "one, and the errors with and without\n"
                                           "its correction");
  command->add_option("--delays", options->delays, "true delays of the time stamps [s]")
      ->capture_default_str()
      ->check(CLI::Range(-0.2, 0.2));
  command->add_option("--duration", options->duration, "duration of each recording [s]")
      ->capture_default_str()
      ->check(CLI::Range(20.0, 3600.0));
  command->add_option("--seeds", options->seeds, "number of recordings per delay")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", options->seed, "random seed of the first recording")->capture_default_str();
  command
      ->add_option("--truth", options->truth,
                   "true parameters of the robot: default, matched, or a truth file")
      ->capture_default_str();
  command
      ->add_option("--parameters", options->parameters,
                   "parameters that are identified with the delay, as in `identify`")
      ->capture_default_str();
  command
      ->add_option("--prior-sigma", options->prior_sigma,
                   "prior standard deviation of the delay about zero [s]")
      ->capture_default_str()
      ->check(CLI::Range(1e-4, 1.0));
  addStudyOptions(*command, *arguments, options->threads, "recordings");
  command->footer(
      "Examples:\n"
      "  capstan-cli study latency\n"
      "  capstan-cli study latency --delays 0.03 --seeds 10 --json latency.json");
  command->callback([options, arguments, &exit] { exit = run(*options, *arguments); });
}

}  // namespace capstan::cli
