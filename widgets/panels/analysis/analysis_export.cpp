// What the analysis panel writes: its two figures and table, or everything that its runs have.
#include <QDateTime>
#include <QFileDialog>
#include <QRegularExpression>
#include <QStandardPaths>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "widgets/figures/save_plot.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/analysis/figure_pair.h"
#include "widgets/panels/analysis/options_bar.h"

namespace capstan::widgets {

namespace {

void writeTable(const base::Table& table, const std::string& path) {
  base::writeTextFile(path + ".md", base::markdownOf(table));
  base::writeTextFile(path + ".tex", base::latexOf(table));
  base::writeTextFile(path + ".csv", base::csvOf(table));
}

}  // namespace

void AnalysisPanel::askExport(const PaperSize& size) {
  const QString name = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + "/Capstan/" +
                       QDateTime::currentDateTime().toString("yyyy-MM-dd_HHmmss") + "-errors";
  auto* dialog =
      new QFileDialog(this, tr("Export figures and table; all file names begin with this name"), name);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  connect(dialog, &QFileDialog::fileSelected, this,
          [this, size](const QString& base) { exportTo(base, size); });
  dialog->open();
}

void AnalysisPanel::exportTo(const QString& base, PaperSize size) {
  if (!figures_->histogram()) return;
  const QString stem = QString(base).remove(QRegularExpression("\\.(pdf|svg|png|csv|md|tex)$"));
  const std::string path = stem.toStdString();
  const PageOptions pages(size, options_->titles());
  try {
    exportFigure(*figures_->histogram(), path + "-histogram", pages);
    exportFigure(*figures_->boxplot(), path + "-boxplot", pages);
    writeTable(analysis::tableOf(analysis_), path + "-table");
    said_ = tr("Exported as %1-histogram, -boxplot and -table.").arg(stem);
    Q_EMIT exported(stem);
  } catch (const base::InputError& error) {
    said_ = QString::fromStdString(error.what());
  }
  say();
}

/// Runs that could be read, with their errors as shown.
std::vector<ExportedRun> AnalysisPanel::exportedRuns() const {
  std::vector<ExportedRun> runs;
  for (const Side& side : sides_)
    if (side.run) runs.push_back({side.picker->choice(), side.run});
  return runs;
}

/// The figures and the table as shown, for two runs.
ExportExtras AnalysisPanel::comparison() const {
  if (!figures_->histogram() || analysis_.title_b.empty()) return {};
  const HistogramData histogram = figures_->histogram()->data();
  const BoxplotData boxplot = figures_->boxplot()->data();
  return {{{"comparison-histogram", FigureKind::kHistogram,
            [histogram] { return std::make_unique<HistogramFigure>(histogram); }},
           {"comparison-boxplot", FigureKind::kBoxplot,
            [boxplot] { return std::make_unique<BoxplotFigure>(boxplot); }}},
          {{"comparison-table", analysis::tableOf(analysis_)}}};
}

void AnalysisPanel::askExportAll() {
  auto* dialog =
      new QFileDialog(this, tr("Folder for all figures and tables: empty, or of an earlier export"),
                      QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
  dialog->setObjectName("ask_export_all");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& folder) { exportAllTo(folder); });
  dialog->open();
}

void AnalysisPanel::exportAllTo(const QString& folder, PaperSize size) {
  const auto runs = exportedRuns();
  if (busy() || runs.empty()) return;
  said_.clear();
  try {
    full_export_.start(runs, comparison(), folder, {size, options_->titles()});
    onProgress(0.0, tr("reading"));
  } catch (const base::InputError& error) {
    said_ = QString::fromStdString(error.what());
  }
  say();
}

}  // namespace capstan::widgets
