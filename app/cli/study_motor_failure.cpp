#include "app/cli/study_motor_failure.h"

#include <cmath>
#include <memory>
#include <string>

#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/table.h"
#include "core/base/yaml.h"
#include "core/experiments/motor_failure_study.h"

namespace capstan::cli {
namespace {

using experiments::MotorFailureStudy;
using experiments::MotorFailureStudyOptions;

nlohmann::json jsonOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options) {
  nlohmann::json cells = nlohmann::json::array();
  for (const auto& cell : study.cells)
    cells.push_back({{"motor", cell.motor == 3 ? nlohmann::json("all") : nlohmann::json(cell.motor + 1)},
                     {"speed", cell.speed},
                     {"occlusion", cell.occlusion},
                     {"held", cell.held},
                     {"share", cell.share},
                     {"whole", cell.whole},
                     {"found", std::isnan(cell.found) ? nlohmann::json() : nlohmann::json(cell.found)},
                     {"normal_rms", toJson(cell.normal_rms)},
                     {"failed_rms", toJson(cell.failed_rms)},
                     {"ratio", cell.ratio()},
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

ExitCode run(const MotorFailureStudyOptions& options, const std::string& csv, const std::string& json) {
  checkOutputs({{"--csv", csv}, {"--json", json}}, {});
  const Output output(json);
  base::Progress progress;
  MotorFailureStudy study;
  {
    const ProgressLine line(progress);
    study = experiments::runMotorFailureStudy(options, progress);
  }
  if (study.cancelled) {
    notice("cancelled");
    return kFailed;
  }
  output.text(base::markdownOf(experiments::mapOf(study, options)));
  output.json(jsonOf(study, options));
  if (!csv.empty()) base::writeTextFile(csv, base::csvOf(experiments::detailsOf(study, options)));
  return kOk;
}

}  // namespace

void addMotorFailureStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<MotorFailureStudyOptions>();
  auto fault = std::make_shared<std::string>("lost");
  auto csv = std::make_shared<std::string>(), json = std::make_shared<std::string>();
  CLI::App* command = study.add_subcommand(
      "motor-failure", "How long joints without motor encoder are known from the camera alone");
  command->add_option("--duration", options->duration, "of each trial, from the failure on [s]")
      ->capture_default_str()
      ->check(CLI::Range(5.0, 3600.0));
  command->add_option("--seeds", options->seeds, "trials a speed and occlusion")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", options->seed, "the first")->capture_default_str();
  command->add_option("--speeds", options->speeds, "by the pace of a block transfer of 200 s")
      ->capture_default_str()
      ->check(CLI::Range(0.05, 3.0));
  command->add_option("--occlusions", options->occlusions, "shares of the time, in intervals of 2 s [%]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 95.0));
  command
      ->add_option("--fault", *fault, "lost: no number; frozen: the count stands still and has to be found")
      ->capture_default_str()
      ->check(CLI::IsMember({"lost", "frozen"}));
  command->add_option("--truth", options->truth, "default, matched, or a truth file")->capture_default_str();
  command->add_flag_callback(
      "--nominal-radii", [options] { options->true_radii = false; },
      "the filter knows the nominal pulleys, not the true ones");
  command->add_flag("--images", options->images, "render pictures (slow) instead of tip positions");
  command->add_option("--threads", options->threads, "trials at the same time")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--csv", *csv, "every number of every cell, as CSV");
  command->add_option("--json", *json, "result as JSON, SI: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli study motor-failure                          # the whole map\n"
      "  capstan-cli study motor-failure --fault frozen --csv map.csv\n"
      "  capstan-cli study motor-failure --images --seeds 1 --speeds 1 --occlusions 20");
  command->callback([options, fault, csv, json, &exit] {
    options->fault = *fault == "lost" ? tracking::MotorFault::kLost : tracking::MotorFault::kFrozen;
    exit = run(*options, *csv, *json);
  });
}

}  // namespace capstan::cli
