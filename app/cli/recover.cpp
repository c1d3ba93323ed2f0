#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/recording/recover.h"
#include "core/recording/schema.h"

namespace capstan::cli {
namespace {

struct RecoverArguments {
  std::string in, out, robot, json;
  bool force = false;
};

std::string wordsOf(const recording::Recovery& recovery) {
  std::string text = recovery.whole() ? std::string("no damage found\n")
                     : recovery.complete()
                         ? fmt::format("damaged, but every row was saved: {}\n", recovery.fault)
                         : fmt::format("damaged: {}\n", recovery.fault);
  text += fmt::format("{:<12}{:>12}{:>12}{:>12}\n", "table", "saved", "damaged", "recorded");
  for (const recording::RecoveredRows& rows : recovery.tables)
    text += fmt::format("{:<12}{:>12}{:>12}{:>12}\n", rows.table, rows.saved, rows.damaged,
                        rows.written ? std::to_string(*rows.written) : "unknown");
  for (const recording::LostRows& lost : recovery.lost)
    text += std::isnan(lost.before)
                ? fmt::format("rows lost    {} after {:.3f} s, at the end\n", lost.count, lost.after)
                : fmt::format("rows lost    {} between {:.3f} s and {:.3f} s\n", lost.count, lost.after,
                              lost.before);
  if (recovery.lost.size() > 1) text += fmt::format("rows lost    {} in all\n", recovery.lost_rows);
  if (recovery.pages.missing > 0)
    text += fmt::format("cut off      the last {} KB of the file\n", recovery.pages.missing_bytes / 1024);
  for (const std::string& key : recovery.lost_header) text += fmt::format("header       lost: {}\n", key);
  if (!recovery.checked)
    text += "Rows without check sums (schema version 1): changed numbers in them are not noticed.\n";
  return text;
}

nlohmann::json documentOf(const recording::Recovery& recovery, const RecoverArguments& arguments) {
  nlohmann::json tables = nlohmann::json::object(), lost = nlohmann::json::array();
  for (const recording::RecoveredRows& rows : recovery.tables)
    tables[rows.table] = {{"saved", rows.saved},
                          {"damaged", rows.damaged},
                          {"written", rows.written ? nlohmann::json(*rows.written) : nlohmann::json()}};
  for (const recording::LostRows& rows : recovery.lost)
    lost.push_back({{"rows", rows.count},
                    {"after", rows.after},
                    {"before", std::isnan(rows.before) ? nlohmann::json() : nlohmann::json(rows.before)}});
  return {{"in", arguments.in},
          {"out", recovery.saved() > 0 ? nlohmann::json(arguments.out) : nlohmann::json()},
          {"whole", recovery.whole()},
          {"complete", recovery.complete()},
          {"fault", recovery.fault},
          {"check_sums", recovery.checked},
          {"tables", tables},
          {"lost", lost},
          {"lost_rows", recovery.lost_rows},
          {"lost_header", recovery.lost_header},
          {"missing_pages", recovery.pages.missing},
          {"missing_bytes", recovery.pages.missing_bytes}};
}

ExitCode recover(const RecoverArguments& arguments) {
  const Output output(arguments.json);
  checkOutputs({{"OUT", arguments.out}, {"--json", arguments.json}}, {arguments.in, arguments.robot});
  if (!arguments.force) refuseExisting("OUT", arguments.out);
  base::Progress progress;
  recording::Recovery recovery;
  {
    const ProgressLine line(progress);
    recovery = recording::recoverSession(arguments.in, arguments.out,
                                         recording::recoverOptions(arguments.robot), &progress);
  }
  if (progress.cancelled()) {
    notice("cancelled");
    return kFailed;
  }
  output.text(recovery.saved() > 0 ? fmt::format("{}\n", arguments.out) + wordsOf(recovery)
                                   : fmt::format("{}: nothing to save\n", arguments.in));
  output.json(documentOf(recovery, arguments));
  if (recovery.saved() == 0) return kFailed;
  return recovery.complete() ? kOk : kIncomplete;
}

}  // namespace

void addRecover(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<RecoverArguments>();
  CLI::App* command =
      app.add_subcommand("recover", "Save the readable rows of a damaged session file into a new one");
  command->add_option("IN", arguments->in, "session file; it is not changed")->required();
  command->add_option("OUT", arguments->out, "session file to write")->required();
  command->add_option("--robot", arguments->robot, "robot file, for a session whose own is lost");
  command->add_flag("--force", arguments->force, "overwrite an existing file");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Exit codes: 0 nothing is lost, 3 something is lost (it is listed), 1 nothing to save, 2 bad argument "
      "or file.\n"
      "Every row is verified by its check sum; damaged rows are left out.\n"
      "Example:\n"
      "  capstan-cli recover damaged.capstan saved.capstan");
  command->callback([arguments, &exit] { exit = recover(*arguments); });
}

}  // namespace capstan::cli
