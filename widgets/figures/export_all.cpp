#include "widgets/figures/export_all.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/published.h"
#include "widgets/figures/export_folder.h"

namespace capstan::widgets {

namespace {

namespace fs = std::filesystem;
using experiments::Results;

std::vector<std::string> namesOf(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  return names;
}

/// A drawing of a figure, which is made when it is drawn.
ExportDrawing drawingOf(ExperimentFigure figure) {
  const std::string name = figure.name;
  return {name, [figure = std::move(figure)](const fs::path& folder, const PageOptions& pages) {
            const auto made = figure.make();
            return IndexFigure{figure.name, made->caption().toStdString(),
                               namesOf(exportFigure(*made, folder / figure.name, pages))};
          }};
}

std::vector<ExperimentFigure> wanted(const std::vector<Results>& results,
                                     const std::vector<FigureKind>& kinds) {
  std::vector<ExperimentFigure> figures;
  for (const Results& one : results)
    for (ExperimentFigure& figure : figuresOf(one))
      if (std::find(kinds.begin(), kinds.end(), figure.kind) != kinds.end())
        figures.push_back(std::move(figure));
  return figures;
}

std::vector<experiments::NamedTable> tablesOf(const std::vector<Results>& results) {
  const experiments::Published published = experiments::readPublished();
  std::vector<experiments::NamedTable> tables;
  for (const Results& one : results)
    for (auto& table : experiments::tablesOf(one, experiments::paperBeside(one, published)))
      tables.push_back({one.name + "-table-" + table.name, std::move(table.table)});
  return tables;
}

IndexTable writeTable(const experiments::NamedTable& named, const fs::path& folder, ExportReport& report) {
  const std::pair<const char*, std::string> formats[] = {
      {".csv", base::csvOf(named.table)},
      {".tex", base::latexOf(named.table, "tab:" + named.name)},
      {".md", base::markdownOf(named.table)}};
  IndexTable entry{named.table, {}};
  for (const auto& [ending, text] : formats) {
    const fs::path file = folder / (named.name + ending);
    base::writeTextFile(file, text);
    report.files.push_back(file);
    entry.files.push_back(file.filename().string());
  }
  ++report.tables;
  return entry;
}

/// Data that results lack, in words, with its consequence.
std::vector<std::string> missingOf(const std::vector<Results>& results) {
  std::vector<std::string> missing;
  for (const Results& one : results) {
    for (const auto& trial : one.trials)
      if (trial.errors.empty())
        missing.push_back(one.name + ", " + trial.name + ": no reference, so there are no errors to show");
    if (one.identification && one.identification->trace.empty())
      missing.push_back(one.name + ": no trace of the dual UKF, so parameters are not shown over time");
  }
  return missing;
}

IndexPage pageFor(const std::vector<Results>& results) {
  IndexPage page;
  for (const Results& one : results) {
    page.title += (page.title.empty() ? "" : " · ") + (one.title.empty() ? one.name : one.title);
    page.simulated = page.simulated || one.simulated;
  }
  page.software = results.front().software;
  return page;
}

}  // namespace

FigureExport::FigureExport(std::vector<Results> results, fs::path folder, const ExportOptions& options,
                           ExportExtras extras)
    : results_(std::move(results)),
      folder_(std::move(folder)),
      pages_(options.size, options.titles),
      drawings_(std::move(extras.drawings)),
      tables_(std::move(extras.tables)),
      settings_(std::move(extras.settings)) {
  checkExportFolder(folder_);
  for (ExperimentFigure& figure : extras.figures) drawings_.push_back(drawingOf(std::move(figure)));
  for (ExperimentFigure& figure : wanted(results_, options.kinds))
    drawings_.push_back(drawingOf(std::move(figure)));
  if (options.tables)
    for (experiments::NamedTable& table : tablesOf(results_)) tables_.push_back(std::move(table));
  if (drawings_.empty() && tables_.empty())
    refuseExport(folder_, "would stay empty: the results have no data for the chosen figures and tables",
                 "Run the experiment whose figures these are");
  report_.missing = missingOf(results_);
  page_ = pageFor(results_);
  page_.missing = report_.missing;
  makeExportFolder(folder_, kFiguresMark);
}

double FigureExport::fraction() const {
  return drawn() ? 1.0 : static_cast<double>(report_.figures) / static_cast<double>(drawings_.size());
}

void FigureExport::draw() {
  page_.figures.push_back(drawings_[report_.figures].draw(folder_, pages_));
  for (const std::string& file : page_.figures.back().files) report_.files.push_back(folder_ / file);
  ++report_.figures;
}

ExportReport FigureExport::finish() {
  report_.cancelled = !drawn();
  for (const auto& table : tables_) page_.tables.push_back(writeTable(table, folder_, report_));
  writeSettings();
  if (report_.cancelled) page_.missing.insert(page_.missing.begin(), "Cancelled: not all figures are here.");
  base::writeTextFile(folder_ / kIndexFile, indexPage(page_));
  report_.files.push_back(folder_ / kIndexFile);
  return report_;
}

void FigureExport::writeSettings() {
  if (settings_.empty()) return;
  page_.others.push_back({"Settings", {}});
  for (const analysis::SettingsFile& file : settings_) {
    base::writeTextFile(folder_ / file.name, file.text);
    report_.files.push_back(folder_ / file.name);
    page_.others.back().files.push_back(file.name);
  }
}

ExportReport exportAll(const std::vector<Results>& results, const fs::path& folder,
                       const ExportOptions& options, base::Progress* progress, ExportExtras extras) {
  FigureExport all(results, folder, options, std::move(extras));
  while (!all.drawn()) {
    if (progress) progress->report(all.fraction(), all.name());
    all.draw();
    if (progress && progress->cancelled()) break;
  }
  return all.finish();
}

}  // namespace capstan::widgets
