#include "widgets/figures/export_all.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/base/yaml.h"
#include "core/experiments/published.h"
#include "core/experiments/tables.h"
#include "widgets/figures/index_page.h"

namespace capstan::widgets {

namespace {

namespace fs = std::filesystem;
using experiments::Results;

constexpr const char* kIndex = "index.html";

[[noreturn]] void refuse(const fs::path& folder, const std::string& reason, const std::string& remedy) {
  throw base::InputError({folder.string(), 0, {}, {}, reason, remedy});
}

bool holdsExport(const fs::path& folder) {
  std::ifstream file(folder / kIndex);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.find(kFiguresMark) != std::string::npos;
}

std::vector<std::string> namesOf(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.filename().string());
  return names;
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

/// In words, what a reader might look for in vain.
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

void checkExportFolder(const fs::path& folder) {
  std::error_code fault;
  if (fs::exists(folder, fault) && !fs::is_directory(folder, fault))
    refuse(folder, "is a file", "Give a folder");
  if (fs::is_directory(folder, fault) && !fs::is_empty(folder, fault) && !holdsExport(folder))
    refuse(folder, "is not empty and holds no former figures", "Give another folder");
  fs::path there = fs::absolute(folder, fault).lexically_normal();
  if (!there.has_filename()) there = there.parent_path();
  while (!fs::exists(there, fault) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, fault)) refuse(there, "is no folder", "Give another folder");
  try {
    base::checkWritable(there / kIndex);
  } catch (const base::InputError&) {
    refuse(folder, "cannot be written: " + there.string() + " takes no files", "Give another folder");
  }
}

ExportReport exportAll(const std::vector<Results>& results, const fs::path& folder,
                       const ExportOptions& options, base::Progress* progress) {
  checkExportFolder(folder);
  const auto figures = wanted(results, options.kinds);
  const auto tables = options.tables ? tablesOf(results) : std::vector<experiments::NamedTable>{};
  if (figures.empty() && tables.empty())
    refuse(folder, "would stay empty: the results hold nothing of what was asked for",
           "Run the experiment whose figures these are");
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) refuse(folder, "cannot be made: " + fault.message(), "Give another folder");

  ExportReport report;
  report.missing = missingOf(results);
  IndexPage page = pageFor(results);
  page.missing = report.missing;
  // The mark first: an export that is interrupted can be repeated into its folder.
  base::writeTextFile(folder / kIndex,
                      std::string(kFiguresMark) + "<p>These figures were not finished.</p>\n");
  for (std::size_t i = 0; i < figures.size() && !report.cancelled; ++i) {
    if (progress)
      progress->report(static_cast<double>(i) / static_cast<double>(figures.size()), figures[i].name);
    const auto figure = figures[i].make();
    const auto files = exportFigure(*figure, folder / figures[i].name, options.size);
    report.files.insert(report.files.end(), files.begin(), files.end());
    page.figures.push_back({figures[i].name, figure->caption().toStdString(), namesOf(files)});
    ++report.figures;
    report.cancelled = progress && progress->cancelled();
  }
  for (const auto& table : tables) page.tables.push_back(writeTable(table, folder, report));
  if (report.cancelled) page.missing.insert(page.missing.begin(), "Cancelled: not all figures are here.");
  base::writeTextFile(folder / kIndex, indexPage(page));
  report.files.push_back(folder / kIndex);
  return report;
}

}  // namespace capstan::widgets
