#include <fmt/format.h>

#include <array>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/pose_motions.h"
#include "core/learning/drift_monitor.h"
#include "core/learning/learn.h"
#include "core/session/correction_file.h"

namespace capstan::cli {
namespace {

struct DriftArguments {
  std::vector<std::string> tables;
  std::string model, json;
  learning::DriftOptions options;
};

constexpr std::array kOutputs = {"x", "y", "z", "the turn about x", "the turn about y", "the turn about z"};

/// Where a state of the recording is found again.
std::string placeOf(const learning::PreparedStates& prepared, std::size_t state) {
  const learning::State& at = prepared.states[state];
  return fmt::format("{}, {:.1f} s (line {})", prepared.screen.motions[at.motion].name, at.t, at.row);
}

nlohmann::json jsonOf(const learning::PreparedStates& prepared, const learning::DriftCourse& course) {
  nlohmann::json json = {{"states", course.t.size()},
                         {"aged", course.aged_from.has_value()},
                         {"aged_share", course.aged_share},
                         {"t", course.t}};
  for (const learning::DriftReport& report : course.reports) {
    json["output"].push_back(kOutputs[static_cast<std::size_t>(report.output)]);
    json["beyond"].push_back(report.beyond);
    json["limit"].push_back(report.limit);
  }
  if (course.aged_from) {
    const learning::State& from = prepared.states[*course.aged_from];
    json["aged_from"] = {
        {"motion", prepared.screen.motions[from.motion].name}, {"t", from.t}, {"line", from.row}};
  }
  return json;
}

std::string textOf(const learning::PreparedStates& prepared, const learning::DriftCourse& course) {
  const learning::DriftReport& last = course.reports.back();
  std::string text = fmt::format(
      "{} states over {:.0f} s; the model did not hold in {:.1f} % of them.\n"
      "At the end {:.0f} % of the errors of {} are beyond the σ stated for them ({:.0f} % as learned; to "
      "tell "
      "from chance, {:.0f} %).\n",
      course.t.size(), course.t.back(), 100.0 * course.aged_share, 100.0 * last.beyond,
      kOutputs[static_cast<std::size_t>(last.output)], 100.0 * learning::kBeyond, 100.0 * last.limit);
  if (course.aged_from)
    return text + fmt::format(
                      "The model has aged: from {} on. Learn anew, or add these motions with learn --onto.\n",
                      placeOf(prepared, *course.aged_from));
  return text + (course.aged_share > 0.0
                     ? "The model holds again at the end: look at what was done between.\n"
                     : "The model holds.\n");
}

ExitCode run(const DriftArguments& arguments) {
  std::vector<std::string> inputs = arguments.tables;
  inputs.push_back(arguments.model);
  checkOutputs({{"--json", arguments.json}}, inputs);
  const session::CorrectionFile file = session::readCorrection(arguments.model);
  learning::PreparedStates prepared =
      learning::prepareAt(file.source.lag, readMotions(arguments.tables), file.source.towards);
  prepared.states = learning::kept(prepared.states, learning::cleanStates(prepared.states));
  if (prepared.states.empty())
    refuseFile(arguments.tables.front(), "has no state that could be judged", "Record longer");
  base::Progress progress;
  learning::DriftCourse course;
  {
    const ProgressLine line(progress);
    course = learning::driftAlong(file.model, prepared.states, arguments.options, &progress);
  }
  if (progress.cancelled()) return kFailed;
  const Output output(arguments.json);
  output.text(textOf(prepared, course));
  output.json(jsonOf(prepared, course));
  return course.aged_from ? kFailed : kOk;
}

}  // namespace

void addDrift(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<DriftArguments>();
  CLI::App* command = app.add_subcommand("drift", "Say whether a learned correction still holds");
  command->add_option("--model", arguments->model, "file that `capstan-cli learn` wrote")->required();
  command->add_option("TABLES", arguments->tables, "tables of tip poses, newer than the model")->required();
  command->add_option("--span", arguments->options.span, "of what is looked at together [s]")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--json", arguments->json, "course as JSON: a file, or - for standard output");
  command->footer(
      "Errors of new motions are compared with the standard deviations that the model states for them:\n"
      "while it holds, 32 % are beyond.\n"
      "Exit code 1 where the model has aged.\n"
      "Example: capstan-cli drift --model arm.correction today.csv");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
