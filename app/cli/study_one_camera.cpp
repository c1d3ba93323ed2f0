#include "app/cli/study_one_camera.h"

#include <memory>
#include <string>

#include "app/cli/study_frame.h"
#include "core/base/names.h"
#include "core/base/table.h"
#include "core/studies/one_camera_study.h"

namespace capstan::cli {
namespace {

using studies::OneCameraResult;
using studies::OneCameraStudy;
using studies::OneCameraStudyOptions;

nlohmann::json documentOf(const OneCameraResult& result) {
  return {{"ukf", toJson(result.all)},
          {"ukf_blocked", toJson(result.blocked)},
          {"nis", result.nis},
          {"ray_nis", result.ray_nis},
          {"ray_share", result.ray_share}};
}

nlohmann::json documentOf(const OneCameraStudy& study) {
  nlohmann::json comparisons = nlohmann::json::array();
  for (const auto& one : study.comparisons)
    comparisons.push_back({{"blocked", one.share / 100.0},
                           {"robot", one.robot},
                           {"filter", one.filter},
                           {"kinematic", toJson(one.kinematic)},
                           {"hard_switch", documentOf(one.hard_switch)},
                           {"ray", documentOf(one.ray)}});
  return {{"comparisons", comparisons}};
}

ExitCode run(OneCameraStudyOptions& options, const std::string& camera, const StudyArguments& arguments) {
  checkStudyOutputs(arguments, "one-camera", {}, {options.truth});
  options.blocked = camera == "left" ? live::BlockedCameras::kLeft : live::BlockedCameras::kRight;
  if (!arguments.out.empty()) options.out = std::filesystem::path(arguments.out) / "trials";
  return runStudy(
      arguments, "one-camera",
      [&](base::Progress& progress, experiments::PartialRun* part) {
        options.part = part;
        return studies::runOneCameraStudy(options, progress);
      },
      [](const OneCameraStudy& study) { return !study.comparisons.empty(); },
      [&](const OneCameraStudy& study) {
        const base::Table table = studies::comparisonsOf(study);
        return StudyReport{
            base::markdownOf(table), documentOf(study), {{"one-camera.csv", base::csvOf(table)}}};
      });
}

}  // namespace

void addOneCameraStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<OneCameraStudyOptions>();
  auto camera = std::make_shared<std::string>("left");
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand(
      "one-camera",
      "Experiment D with one camera blocked: the UKF paper's hard switch beside the ray of the other camera");
  command->add_option("--occlude", options->shares, "shares of the time with one blocked camera [%]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--camera", *camera, "camera that is blocked: left or right")
      ->capture_default_str()
      ->check(CLI::IsMember({"left", "right"}));
  command->add_option("--duration", options->duration, "duration of each block transfer [s]")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 3600.0));
  command->add_option("--seed", options->seed, "random seed of the surgeon's motion, noise and texture")
      ->capture_default_str();
  command
      ->add_option("--truth", options->truth,
                   "true parameters of the robot: default, matched, or a truth file")
      ->capture_default_str();
  addStudyOptions(*command, *arguments, options->threads, "shares");
  command->footer("Example: capstan-cli study one-camera --occlude 40 80 --camera right --json -");
  command->callback([options, camera, arguments, &exit] { exit = run(*options, *camera, *arguments); });
}

}  // namespace capstan::cli
