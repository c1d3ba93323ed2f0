#include "widgets/panels/analysis/full_export.h"

#include <QDir>
#include <algorithm>
#include <exception>

#include "core/analysis/results_to_draw.h"
#include "core/base/software.h"

namespace capstan::widgets {

using experiments::Results;
using Kind = RunChoice::Kind;

namespace {

constexpr double kReading = 0.5;  ///< share of reading in the progress

Results resultsOf(const ExportedRun& run) {
  if (run.choice.kind == Kind::kResults) return experiments::readResults(run.choice.path.toStdString());
  return analysis::resultsOfErrors(*run.run, base::software());
}

/// Results are exported as a whole, so two trials of the same results are one export.
bool same(const ExportedRun& a, const ExportedRun& b) {
  if (a.choice.kind != b.choice.kind) return false;
  return a.choice.kind == Kind::kSession ||
         (a.choice.path == b.choice.path && a.choice.robot == b.choice.robot);
}

std::vector<Results> readAll(const std::vector<ExportedRun>& runs, base::Progress& progress) {
  std::vector<Results> all;
  for (const ExportedRun& run : runs)
    if (!progress.cancelled()) all.push_back(resultsOf(run));
  analysis::distinguish(all);
  return all;
}

}  // namespace

FullExport::FullExport(QObject* parent) : StepExport(parent) {
  connect(&job_, &Job::progressed, this,
          [this](double fraction, const QString& doing) { Q_EMIT progressed(kReading * fraction, doing); });
  connect(&job_, &Job::failed, this, [this](const QString& why) { fault_ = why; });
  connect(&job_, &Job::ended, this, [this] {
    if (!drawing_) end({}, fault_.isEmpty() ? tr("Cancelled: nothing was exported.") : fault_);
  });
}

void FullExport::start(const std::vector<ExportedRun>& runs, ExportExtras extras, const QString& folder,
                       const PageOptions& pages) {
  checkExportFolder(folder.toStdString());
  folder_ = folder;
  pages_ = pages;
  extras_ = std::move(extras);
  fault_.clear();
  std::vector<ExportedRun> once;
  for (const ExportedRun& run : runs)
    if (std::none_of(once.begin(), once.end(), [&](const ExportedRun& other) { return same(run, other); }))
      once.push_back(run);
  job_.start([once = std::move(once)](base::Progress& progress) { return readAll(once, progress); },
             [this](std::vector<Results> all) { onRead(std::move(all)); });
}

void FullExport::onRead(std::vector<Results> all) {
  try {
    ExportOptions options;
    options.size = pages_.size;
    options.titles = pages_.titles;
    drawing_ =
        std::make_unique<FigureExport>(std::move(all), folder_.toStdString(), options, std::move(extras_));
    begin();
  } catch (const std::exception& error) {
    fault_ = QString::fromStdString(error.what());  // said when the job has ended
  }
}

void FullExport::step() {
  if (drawing_->drawn()) return finish();
  drawing_->draw();
  Q_EMIT progressed(kReading + (1.0 - kReading) * drawing_->fraction(), tr("drawing"));
}

void FullExport::cancel() {
  job_.cancel();
  if (drawing_) attempt([this] { finish(); });
}

void FullExport::finish() {
  const ExportReport report = drawing_->finish();
  const QString index = QDir::toNativeSeparators(QString::fromStdString(report.files.back().string()));
  QString words = tr("%1 figures and %2 tables: open %3").arg(report.figures).arg(report.tables).arg(index);
  if (report.cancelled) words = tr("Cancelled. ") + words;
  end(index, words);
}

}  // namespace capstan::widgets
