#include "app/cli/study_health.h"

#include <memory>
#include <string>

#include "app/cli/study_frame.h"
#include "core/base/names.h"
#include "core/base/table.h"
#include "core/studies/health_study.h"

namespace capstan::cli {
namespace {

using studies::HealthStudy;
using studies::HealthStudyCase;
using studies::HealthStudyOptions;

nlohmann::json documentOf(const HealthStudy& study) {
  nlohmann::json cases = nlohmann::json::array();
  for (const HealthStudyCase& one : study.cases) {
    nlohmann::json verdicts;
    for (const auto& [verdict, name] : base::NamesOf<tracking::HealthVerdict>::value)
      verdicts[name] = one.verdicts[static_cast<std::size_t>(verdict)];
    cases.push_back({{"fault", one.fault},
                     {"expected", one.expected},
                     {"verdicts", verdicts},
                     {"named", one.named},
                     {"other", one.other},
                     {"other_checks", one.others},
                     {"nis_low", toJson(one.nis_low)},
                     {"nis_high", toJson(one.nis_high)},
                     {"ukf", toJson(one.rms)}});
  }
  return {{"cases", cases}};
}

ExitCode run(HealthStudyOptions& options, const StudyArguments& arguments) {
  checkStudyOutputs(arguments, "health", {}, {options.truth});
  if (!arguments.out.empty()) options.out = std::filesystem::path(arguments.out) / "trials";
  return runStudy(
      arguments, "health",
      [&](base::Progress& progress, experiments::PartialRun* part) {
        options.part = part;
        return studies::runHealthStudy(options, progress);
      },
      [](const HealthStudy& study) { return !study.cases.empty(); },
      [&](const HealthStudy& study) {
        const base::Table table = studies::casesOf(study);
        return StudyReport{base::markdownOf(table), documentOf(study), {{"health.csv", base::csvOf(table)}}};
      });
}

}  // namespace

void addHealthStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<HealthStudyOptions>();
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand(
      "health", "Verdicts of the estimator's health on simulated sessions with one known fault each");
  command->add_option("--sessions", options->sessions, "sessions per fault")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--duration", options->duration, "duration of each session [s]")
      ->capture_default_str()
      ->check(CLI::Range(5.0, 3600.0));
  command
      ->add_option("--seed", options->seed,
                   "random seed of the first session; the limits were chosen on seeds 1 to 10")
      ->capture_default_str();
  command
      ->add_option("--truth", options->truth,
                   "true parameters of the robot: default, matched, or a truth file")
      ->capture_default_str();
  addStudyOptions(*command, *arguments, options->threads, "sessions");
  command->footer("Example: capstan-cli study health --sessions 5 --json -");
  command->callback([options, arguments, &exit] { exit = run(*options, *arguments); });
}

}  // namespace capstan::cli
