#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/export_output.h"
#include "app/cli/file_drawing.h"
#include "app/cli/outputs.h"
#include "core/analysis/results_to_draw.h"
#include "core/base/error.h"
#include "core/base/software.h"
#include "widgets/figures/export_all.h"

namespace capstan::cli {
namespace {

namespace fs = std::filesystem;
using experiments::Results;

struct FiguresArguments {
  std::vector<std::string> inputs, only;
  std::string out = "capstan-figures", size = "180x120", json;
  bool no_titles = false;
};

/// Tracks a recording as the only trial of an experiment without output. Returns false if cancelled.
bool track(const fs::path& file, std::vector<Results>& all) {
  base::Progress progress;
  const ProgressLine line(progress);
  Results results = analysis::resultsOfRecording(file, {}, base::software(), progress);
  if (results.cancelled) return false;
  all.push_back(std::move(results));
  return true;
}

/// Refuses two results with the same name, because file names begin with it. Throws base::InputError.
void refuseTwins(const std::vector<Results>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (all[i].name == all[j].name)
        refuseOption("INPUT", all[i].name, "is the name of two of the results",
                     "Export them into two folders");
}

/// Reads results and tracks recordings into `all`. Returns false if cancelled.
bool readInputs(const std::vector<std::string>& inputs, std::vector<Results>& all) {
  for (const std::string& input : inputs)
    if (!fs::exists(input))
      refuseFile(input, "does not exist",
                 "Give a folder of results (capstan-cli experiment), or a recording");
  for (const std::string& input : inputs) {
    if (!fs::is_directory(input)) {
      if (!track(input, all)) return false;
      continue;
    }
    for (const fs::path& folder : analysis::resultFolders(input))
      all.push_back(experiments::readResults(folder));
  }
  refuseTwins(all);
  return true;
}

widgets::ExportOptions optionsOf(const FiguresArguments& arguments) {
  widgets::ExportOptions options;
  options.size = widgets::parsePaperSize(arguments.size);
  options.titles = !arguments.no_titles;
  if (arguments.only.empty()) return options;
  options.tables = false;
  options.kinds.clear();
  for (const std::string& one : arguments.only) {
    if (one == "tables") options.tables = true;
    for (const auto& [kind, name] : base::NamesOf<widgets::FigureKind>::value)
      if (one == name) options.kinds.push_back(kind);
  }
  return options;
}

widgets::ExportReport draw(const std::vector<Results>& results, const FiguresArguments& arguments,
                           const widgets::ExportOptions& options) {
  base::Progress progress;
  const ProgressLine line(progress);
  return widgets::exportAll(results, arguments.out, options, &progress);
}

ExitCode figures(const FiguresArguments& arguments) {
  const widgets::ExportOptions options = optionsOf(arguments);
  widgets::checkExportFolder(arguments.out);
  checkOutputs({{"--json", arguments.json}}, arguments.inputs);
  const Output output(arguments.json);
  const FileDrawing drawing;
  std::vector<Results> results;
  if (!readInputs(arguments.inputs, results)) {
    notice("cancelled: nothing was written");
    return kFailed;
  }
  const widgets::ExportReport report = draw(results, arguments, options);
  return print(report, output);
}

}  // namespace

void addFigures(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<FiguresArguments>();
  CLI::App* command = app.add_subcommand(
      "figures", "Draw the figures and tables of experiments or recordings into a folder with an index page");
  command
      ->add_option("INPUT", arguments->inputs,
                   "results of capstan-cli experiment (a folder), or recordings (.capstan, .csv)")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "folder: new, empty, or of a former run, whose files are overwritten")
      ->capture_default_str();
  command->add_option("--size", arguments->size, "size of a figure on paper, WxH [mm]")
      ->capture_default_str();
  command->add_flag("--no-titles", arguments->no_titles,
                    "put titles and notes only into the captions of the index page");
  command
      ->add_option("--only", arguments->only,
                   "kinds to draw: trajectories, parameters, histograms, boxplots, tables")
      ->delimiter(',')
      ->check(CLI::IsMember({"trajectories", "parameters", "histograms", "boxplots", "tables"}));
  command->add_option("--json", arguments->json,
                      "names of all files as JSON: a file, or - for standard output");
  command->footer(
      "Each figure is written as PDF, SVG, PNG (300 dpi) and CSV (its numbers), each table as CSV, LaTeX\n"
      "and Markdown. A figure whose panels would be lower than 10 mm is written as a page for each joint:\n"
      "NAME-page-1.pdf, NAME-page-2.pdf and so on. Only files of the same names are overwritten; nothing is\n"
      "deleted. Examples:\n"
      "  capstan-cli figures results --out figures           (everything that capstan-cli experiment wrote)\n"
      "  capstan-cli figures results --out column --size 88x90 --only boxplots,histograms\n"
      "  capstan-cli figures trial.capstan --out trial_figures");
  command->callback([arguments, &exit] { exit = figures(*arguments); });
}

}  // namespace capstan::cli
