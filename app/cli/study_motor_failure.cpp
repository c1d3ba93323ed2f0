#include "app/cli/study_motor_failure.h"

#include <cmath>
#include <memory>
#include <string>

#include "app/cli/study_frame.h"
#include "core/base/table.h"
#include "core/base/yaml.h"
#include "core/studies/motor_failure_study.h"

namespace capstan::cli {
namespace {

using studies::MotorFailureStudy;
using studies::MotorFailureStudyOptions;
using studies::NormalError;

/// For each normal error: how long the failed joints stay within twice this error.
nlohmann::json normalsOf(const studies::MotorFailureResult& cell) {
  nlohmann::json all;
  for (const auto& [normal, name] : base::NamesOf<NormalError>::value) {
    const studies::Endurance& endurance = cell.endurance(normal);
    all[std::string(name)] = {{"rms", toJson(cell.normal(normal))},
                              {"held", endurance.held},
                              {"share", endurance.share},
                              {"whole", endurance.whole},
                              {"ratio", cell.ratio(normal)}};
  }
  return all;
}

nlohmann::json documentOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options) {
  nlohmann::json cells = nlohmann::json::array();
  for (const auto& cell : study.cells)
    cells.push_back({{"motor", cell.motor == 3 ? nlohmann::json("all") : nlohmann::json(cell.motor + 1)},
                     {"speed", cell.speed},
                     {"occlusion", cell.occlusion / 100.0},
                     {"found", std::isnan(cell.found) ? nlohmann::json() : nlohmann::json(cell.found)},
                     {"failed_rms", toJson(cell.failed_rms)},
                     {"normal", normalsOf(cell)},
                     {"nees", cell.nees}});
  return {{"fault", base::nameOf(options.fault)},
          {"duration", options.duration},
          {"warm_up", options.warm_up},
          {"seeds", options.seeds},
          {"seed", options.seed},
          {"truth", options.truth},
          {"true_radii", options.true_radii},
          {"images", options.images},
          {"cells", cells}};
}

ExitCode run(MotorFailureStudyOptions& options, const std::string& csv, const StudyArguments& arguments) {
  checkStudyOutputs(arguments, "motor-failure", {{"--csv", csv}}, {options.truth});
  if (!arguments.out.empty()) options.out = std::filesystem::path(arguments.out) / "trials";
  return runStudy(
      arguments, "motor-failure",
      [&](base::Progress& progress, experiments::PartialRun* part) {
        options.part = part;
        return studies::runMotorFailureStudy(options, progress);
      },
      [](const MotorFailureStudy&) { return false; },
      [&](const MotorFailureStudy& study) {
        StudyReport report;
        for (const NormalError normal : {NormalError::kOwn, NormalError::kNominal}) {
          if (normal == NormalError::kNominal && !options.true_radii) continue;  // the same
          report.text +=
              (report.text.empty() ? "" : "\n") + base::markdownOf(studies::mapOf(study, options, normal));
        }
        const std::string details = base::csvOf(studies::detailsOf(study, options));
        if (!csv.empty()) base::writeTextFile(csv, details);
        report.json = documentOf(study, options);
        report.files = {{"motor-failure.csv", details}};
        return report;
      },
      {{"--csv", csv}});
}

}  // namespace

void addMotorFailureStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<MotorFailureStudyOptions>();
  auto fault = std::make_shared<std::string>("lost");
  auto csv = std::make_shared<std::string>();
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand(
      "motor-failure",
      "Errors of joint estimates when a motor encoder has failed and only the camera observes its joint");
  command->add_option("--duration", options->duration, "duration of each trial after the failure [s]")
      ->capture_default_str()
      ->check(CLI::Range(5.0, 3600.0));
  command->add_option("--seeds", options->seeds, "number of trials per speed and occlusion")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", options->seed, "random seed of the first trial")->capture_default_str();
  command->add_option("--speeds", options->speeds, "speeds relative to a block transfer of 200 s")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 3.0));
  command
      ->add_option("--occlusions", options->occlusions,
                   "shares of the time with blocked cameras, in intervals of 2 s [%]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 95.0));
  command
      ->add_option("--fault", *fault,
                   "lost: no number; frozen: a constant count, which the filter has to detect")
      ->capture_default_str()
      ->check(CLI::IsMember({"lost", "frozen"}));
  command
      ->add_option("--truth", options->truth,
                   "true parameters of the robot: default, matched, or a truth file")
      ->capture_default_str();
  command->add_flag_callback(
      "--nominal-radii", [options] { options->true_radii = false; },
      "the filter has the nominal pulley radii, not the true ones");
  command->add_flag("--images", options->images, "render images (slow) instead of tip positions");
  command->add_option("--csv", *csv, "file for all numbers of all trials, as CSV");
  addStudyOptions(*command, *arguments, options->threads, "trials");
  command->footer(
      "Examples:\n"
      "  capstan-cli study motor-failure --out failures           # continues where it was stopped\n"
      "  capstan-cli study motor-failure --fault frozen --csv map.csv\n"
      "  capstan-cli study motor-failure --images --seeds 1 --speeds 1 --occlusions 20");
  command->callback([options, fault, csv, arguments, &exit] {
    options->fault = *fault == "lost" ? tracking::MotorFault::kLost : tracking::MotorFault::kFrozen;
    exit = run(*options, *csv, *arguments);
  });
}

}  // namespace capstan::cli
