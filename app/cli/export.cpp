#include <memory>
#include <string>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/export_output.h"
#include "app/cli/file_drawing.h"
#include "app/cli/outputs.h"
#include "core/analysis/results_to_draw.h"
#include "core/base/software.h"
#include "core/recording/recording_kinds.h"
#include "widgets/figures/recording_history.h"
#include "widgets/figures/session_extras.h"

namespace capstan::cli {
namespace {

struct ExportArguments {
  std::string recording, robot, out = "capstan-export", size = "180x120", json;
};

ExitCode exportSession(const ExportArguments& arguments) {
  widgets::ExportOptions options;
  options.size = widgets::parsePaperSize(arguments.size);
  widgets::checkExportFolder(arguments.out);
  checkOutputs({{"--json", arguments.json}}, {arguments.recording, arguments.robot});
  const Output output(arguments.json);
  const FileDrawing drawing;
  base::Progress progress;
  const ProgressLine line(progress);
  widgets::RecordingHistory rows;
  const analysis::SessionRecord record =
      analysis::recordOf(arguments.recording, arguments.robot, progress,
                         [&rows](const tracking::Snapshot& snapshot) { rows.add(snapshot); });
  if (progress.cancelled()) {
    notice("cancelled: nothing was written");
    return kFailed;
  }
  return print(widgets::exportAll({analysis::resultsOfErrors(record.run, base::software())}, arguments.out,
                                  options, &progress, widgets::sessionExtras(record, rows.history())),
               output);
}

}  // namespace

void addExport(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Write everything about one recording into a folder with an index page");
  command->add_option("RECORDING", arguments->recording, recording::recordingKinds())->required();
  command
      ->add_option("--out", arguments->out,
                   "folder: new, empty, or of a former run, whose files are overwritten")
      ->capture_default_str();
  command->add_option("--robot", arguments->robot, "robot file; a session contains its own");
  command->add_option("--size", arguments->size, "size of a figure on paper, WxH [mm]")
      ->capture_default_str();
  command->add_option("--json", arguments->json,
                      "names of all files as JSON: a file, or - for standard output");
  command->footer(
      "The recording is tracked once. The folder then holds the joint plots, trajectory, histograms and box\n"
      "plot of the errors (PDF, SVG, PNG, CSV), the tables of errors, the report and the events (CSV, "
      "LaTeX,\n"
      "Markdown), and the settings as files: robot, filter, marker, cameras, registration. The window's\n"
      "Export everything writes the same of the open session. Examples:\n"
      "  capstan-cli export trial.capstan --out trial_export\n"
      "  capstan-cli export trial.capstan --robot identified.yaml --out identified_export");
  command->callback([arguments, &exit] { exit = exportSession(*arguments); });
}

}  // namespace capstan::cli
