#include <fmt/format.h>

#include <array>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/pose_motions.h"
#include "core/learning/model/correction_file.h"
#include "core/learning/model/drift_monitor.h"
#include "core/learning/model/learn.h"
#include "core/learning/poses/related_streams.h"
#include "core/recording/pose_table.h"

namespace capstan::cli {
namespace {

struct DriftArguments {
  std::vector<std::string> tables;
  std::string model, json;
  learning::DriftOptions options;
};

constexpr std::array kOutputs = {
    "x", "y", "z", "the rotation about x", "the rotation about y", "the rotation about z"};

enum class Finding { kHolds, kDrifted, kUnknown };

Finding findingOf(const learning::DriftHistory& history) {
  if (!history.known()) return Finding::kUnknown;
  return history.driftedNow() ? Finding::kDrifted : Finding::kHolds;
}

const char* nameOf(Finding finding) {
  return finding == Finding::kHolds ? "holds" : finding == Finding::kDrifted ? "drifted" : "unknown";
}

/// Text that locates a state in its table: trajectory, time and line.
std::string placeOf(const learning::PreparedStates& prepared, std::size_t state) {
  const learning::State& at = prepared.states[state];
  return fmt::format("{}, t {:.1f} s (line {})", prepared.screen.motions[at.motion].name, at.t, at.row);
}

nlohmann::json documentOf(const learning::PreparedStates& prepared, const learning::DriftHistory& history) {
  nlohmann::json json = {{"finding", nameOf(findingOf(history))},
                         {"judged", history.t.size()},
                         {"low_confidence", history.low_confidence},
                         {"factor", std::vector<double>(history.factor.begin(), history.factor.end())},
                         {"t", history.t},
                         {"drifted", nlohmann::json::array()}};
  for (const learning::DriftReport& report : history.reports) {
    json["output"].push_back(kOutputs[static_cast<std::size_t>(report.output)]);
    json["beyond"].push_back(report.beyond);
    json["limit"].push_back(report.limit);
  }
  for (const auto& [from, to] : history.drifted) {
    const learning::State& begin = prepared.states[history.state[from]];
    const learning::State& end = prepared.states[history.state[to - 1]];
    json["drifted"].push_back({{"from_line", begin.row}, {"to_line", end.row}});
  }
  return json;
}

std::string wordsOf(const learning::PreparedStates& prepared, std::size_t states,
                    const learning::DriftHistory& history) {
  std::string text = fmt::format(
      "{} of {} states count; for {} of these the model's confidence is low (below {}): they do not\n"
      "test it.\n",
      prepared.states.size(), states, history.low_confidence, learning::kLowConfidence);
  if (2 * history.low_confidence > prepared.states.size())
    text += "Most recorded poses lie outside the learned region: add them to the training.\n";
  if (findingOf(history) == Finding::kUnknown)
    return text + fmt::format("Too short to test the model: at least {} s of motion are needed.\n",
                              learning::kFewestPieces);
  text += "Errors divided by their stated σ (about 1 or less while the model is valid):";
  for (std::size_t i = 0; i < kOutputs.size(); ++i)
    text += fmt::format("{} {} {:.2f}", i == 0 ? "" : ",", kOutputs[i],
                        history.factor[static_cast<Eigen::Index>(i)]);
  const learning::DriftReport& last = history.reports.back();
  text += fmt::format(
      "\nIn the last {:.0f} s, {:.0f} % of the errors of {} are larger than their σ:\n"
      "a valid model gives at most {:.0f} %, and more than {:.0f} % are significant.\n",
      last.span, 100.0 * last.beyond, kOutputs[static_cast<std::size_t>(last.output)],
      100.0 * learning::kBeyond, 100.0 * last.limit);
  for (const auto& [from, to] : history.drifted)
    text += fmt::format("Drift was detected from {} to {}.\n", placeOf(prepared, history.state[from]),
                        placeOf(prepared, history.state[to - 1]));
  return text + (history.driftedNow() ? "The model has drifted: retrain on motions as they are now.\n"
                                      : "Nothing shows that the model has drifted.\n");
}

learning::PreparedStates preparedFor(const learning::CorrectionFile& file,
                                     const std::vector<std::string>& tables) {
  learning::PreparedStates prepared =
      learning::prepareAt(file.source.clock_offset, recording::readPoseTables(tables), file.source.towards);
  learning::checkRelated(prepared.screen.motions, prepared.states, file.model.offset(), file.source.towards);
  return prepared;
}

ExitCode run(const DriftArguments& arguments) {
  std::vector<std::string> inputs = arguments.tables;
  inputs.push_back(arguments.model);
  checkOutputs({{"--json", arguments.json}}, inputs);
  const learning::CorrectionFile file = learning::readCorrection(arguments.model);
  checkProcesses(file.model, arguments.model);
  checkNew(arguments.tables, file.source);
  learning::PreparedStates prepared =
      recording::namingTables(arguments.tables, [&] { return preparedFor(file, arguments.tables); });
  const std::size_t states = prepared.states.size();
  prepared.states = learning::kept(
      prepared.states, learning::cleanStates(prepared.states, learning::LearningOptions{}.cleaning));
  base::Progress progress;
  learning::DriftHistory history;
  {
    const ProgressLine line(progress);
    history = learning::driftAlong(file.model, prepared.states, arguments.options, &progress);
  }
  if (progress.cancelled()) return kFailed;
  const Output output(arguments.json);
  output.text(wordsOf(prepared, states, history));
  output.json(documentOf(prepared, history));
  return findingOf(history) == Finding::kHolds ? kOk : kFailed;
}

}  // namespace

void addDrift(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<DriftArguments>();
  CLI::App* command = app.add_subcommand("drift", "Test whether a learned correction is still valid");
  command->add_option("--model", arguments->model, "file that `capstan-cli learn` wrote")->required();
  command->add_option("TABLES", arguments->tables, "tables of tip poses, newer than the model")->required();
  command->add_option("--span", arguments->options.span, "longest window of motion for one test [s]")
      ->capture_default_str()
      ->check(CLI::Range(static_cast<double>(learning::kFewestPieces), 1e5));
  command->add_option("--json", arguments->json, "history as JSON: a file, or - for standard output");
  command->footer(
      "Errors of new motions are compared with the standard deviations that the model states, where its\n"
      "confidence is high. Exit code 0: the model is valid; 1: it has drifted, or the motions are too short\n"
      "for a test.\n"
      "Example: capstan-cli drift --model arm.correction today.csv");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
