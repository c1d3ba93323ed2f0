#include "widgets/shell/export_controller.h"

#include <QAction>
#include <QDateTime>
#include <QDesktopServices>
#include <QFileDialog>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QUrl>
#include <QWidget>

#include "widgets/figures/joint_figure.h"
#include "widgets/figures/save_figure.h"
#include "widgets/figures/session_extras.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/analysis_controller.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

namespace {

constexpr const char* kAbout = "export";

/// A path in the user's documents that names the present moment.
QString nameOfNow() {
  return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + "/Capstan/" +
         QDateTime::currentDateTime().toString("yyyy-MM-dd_HHmmss");
}

}  // namespace

ExportController::ExportController(const Views& views, const AnalysisController& errors, SessionLink& link,
                                   SessionBar& bar, QObject* parent)
    : QObject(parent), views_(views), errors_(errors), link_(link) {
  connect(&bar, &SessionBar::exportRequested, this, &ExportController::askPlots);
  connect(&bar, &SessionBar::exportEverythingRequested, this, &ExportController::askEverything);
  connect(&link, &SessionLink::opened, this, &ExportController::gather);
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) { now_ = status.t; });
  connect(&views.notes, &NotesPanel::eventAdded, this,
          [this](double t, const QString& kind, const QString& text) {
            events_.push_back({t, kind.toStdString(), text.toStdString()});
          });
  connect(&everything_, &FullExport::progressed, this, &ExportController::showProgress);
  connect(&everything_, &FullExport::ended, this, &ExportController::showEnd);
}

void ExportController::gather(const tracking::SourceInfo& info, const SourceChoice& choice) {
  everything_.cancel();  // its plots were of the session before
  events_.clear();
  title_ = titleOf(choice, info.title).toStdString();
  for (std::size_t i = 0; i < 3 && i < info.robot.joints.size(); ++i)
    joint_names_[i] = QString::fromStdString(info.robot.joints[i].name);
}

void ExportController::askPlots() {
  auto* dialog = new QFileDialog(qobject_cast<QWidget*>(parent()),
                                 tr("Export the plots as PDF, SVG, PNG and CSV"), nameOfNow());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  connect(dialog, &QFileDialog::fileSelected, this, &ExportController::exportPlots);
  dialog->open();
}

void ExportController::askEverything() {
  auto* dialog = new QFileDialog(qobject_cast<QWidget*>(parent()),
                                 tr("Name of a new folder for everything about this session"), nameOfNow());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setLabelText(QFileDialog::FileName, tr("Folder:"));
  connect(dialog, &QFileDialog::fileSelected, this, &ExportController::exportEverything);
  dialog->open();
}

void ExportController::exportPlots(const QString& base) {
  try {
    const QCPRange range = views_.figure.timeRange();
    const std::string path = QString(base).remove(QRegularExpression("\\.(pdf|svg|png|csv)$")).toStdString();
    exportJointFigure(views_.figure.history(), joint_names_, range.lower, range.upper, path);
    views_.notes.addFile(now_, "export", QString::fromStdString(path));
    views_.faults.settle(kAbout);
  } catch (const std::exception& error) {
    fail(error);
  }
}

void ExportController::exportEverything(const QString& folder) {
  if (busy() || !link_.runner()) return;
  try {
    const analysis::SessionRecord now = record();
    everything_.start({{{RunChoice::Kind::kSession}, std::make_shared<analysis::ErrorRun>(now.run)}},
                      sessionExtras(now, views_.figure.history()), folder, {PaperSize{}, true});
    views_.faults.settle(kAbout);
    views_.news.showNews(tr("Exporting everything…"), {{tr("Cancel"), [this] { everything_.cancel(); }}});
  } catch (const std::exception& error) {
    fail(error);
  }
}

analysis::SessionRecord ExportController::record() const {
  const live::Runner& runner = *link_.runner();
  analysis::SessionRecord record;
  record.run = errors_.soFar();
  record.run.title = title_;
  record.report = runner.report();
  record.health = runner.health();
  for (std::size_t i = 0; i < 3; ++i) record.joint_names[i] = joint_names_[i].toStdString();
  record.events = events_;
  record.settings = analysis::settingsOf(runner.inUse(recording::headerOf(runner.info(), {})));
  return record;
}

void ExportController::showProgress(double fraction, const QString&) {
  views_.news.setText(tr("Exporting everything: %1 %").arg(qRound(100.0 * fraction)));
}

void ExportController::showEnd(const QString& index, const QString& words) {
  views_.news.hide();
  if (index.isEmpty()) return views_.faults.showMessage(words, kAbout);
  views_.notes.addFile(now_, "export", index);
  views_.news.showNews(words,
                       {{tr("Open"), [index] { QDesktopServices::openUrl(QUrl::fromLocalFile(index)); }}});
}

void ExportController::fail(const std::exception& error) {
  views_.faults.showMessage(QString::fromUtf8(error.what()), kAbout);
}

}  // namespace capstan::widgets
