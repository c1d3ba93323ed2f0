#include "app/cli/study_filter.h"

#include <memory>
#include <string>
#include <vector>

#include "app/cli/study_frame.h"
#include "core/base/table.h"
#include "core/studies/filter_study.h"

namespace capstan::cli {
namespace {

using studies::FilterResult;
using studies::FilterStudy;
using studies::FilterStudyOptions;

nlohmann::json documentOf(const FilterResult& result) {
  return {{"ukf", toJson(result.ukf)},
          {"nis", result.nis},
          {"nis_consistent_share", result.consistent},
          {"nees", result.nees},
          {"scale", toJson(result.transmission.scale)},
          {"offset", toJson(result.transmission.offset)}};
}

nlohmann::json documentOf(const FilterStudy& study) {
  nlohmann::json comparisons = nlohmann::json::array();
  for (const auto& one : study.comparisons)
    comparisons.push_back({{"recording", one.recording},
                           {"robot", one.robot},
                           {"disturbance", one.disturbance},
                           {"occlusion", one.occlusion / 100.0},
                           {"kinematic", toJson(one.kinematic)},
                           {"camera", toJson(one.camera)},
                           {"six_state", documentOf(one.six_state)},
                           {"augmented", documentOf(one.augmented)}});
  return {{"comparisons", comparisons}};
}

ExitCode run(FilterStudyOptions& options, const std::vector<std::string>& files,
             const StudyArguments& arguments) {
  std::vector<std::string> inputs = files;
  inputs.push_back(options.truth);
  inputs.push_back(options.robot.string());
  checkStudyOutputs(arguments, "filter", {}, inputs);
  options.recordings.assign(files.begin(), files.end());
  if (!arguments.out.empty()) options.out = std::filesystem::path(arguments.out) / "trials";
  return runStudy(
      arguments, "filter",
      [&](base::Progress& progress, experiments::PartialRun* part) {
        options.part = part;
        return studies::runFilterStudy(options, progress);
      },
      [](const FilterStudy& study) { return !study.comparisons.empty(); },
      [&](const FilterStudy& study) {
        const base::Table table = studies::comparisonsOf(study);
        return StudyReport{base::markdownOf(table), documentOf(study), {{"filter.csv", base::csvOf(table)}}};
      });
}

}  // namespace

void addFilterStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<FilterStudyOptions>();
  auto files = std::make_shared<std::vector<std::string>>();
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand(
      "filter", "The six-state filter of the UKF paper beside the augmented one, on the same samples");
  command->add_option(
      "FILES", *files,
      "recordings with joint encoders: measured tables or sessions; default: simulated sessions");
  command->add_option("--robot", options->robot, "robot file, for recordings that contain none");
  command
      ->add_option("--occlude", options->occlusions,
                   "shares of the time with blocked cameras, in intervals of 2 s [%]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 95.0));
  command->add_option("--duration", options->duration, "duration of each simulation [s]")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 3600.0));
  command->add_option("--seeds", options->seeds, "number of simulations")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", options->seed, "random seed of the first simulation")->capture_default_str();
  command
      ->add_option("--truth", options->truth,
                   "true parameters of the robot: default, matched, or a truth file")
      ->capture_default_str();
  command->add_option("--settled", options->settled, "start time of the NIS statistics [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 3600.0));
  command->add_flag_callback(
      "--no-images", [options] { options->images = false; }, "simulate tip positions instead of images");
  command->add_flag("--disturbed", options->disturbed,
                    "repeat each session with moved cameras, slipping motors and wrong constants;\n"
                    "tip positions are simulated instead of images");
  addStudyOptions(*command, *arguments, options->threads, "recordings");
  command->footer(
      "Examples:\n"
      "  capstan-cli study filter                               (ten sessions, nominal and true radii)\n"
      "  capstan-cli study filter --occlude 40 80 --seeds 3\n"
      "  capstan-cli study filter --disturbed --seeds 1\n"
      "  capstan-cli study filter monday.csv tuesday.csv --robot arm.yaml --out filters");
  command->callback([options, files, arguments, &exit] { exit = run(*options, *files, *arguments); });
}

}  // namespace capstan::cli
