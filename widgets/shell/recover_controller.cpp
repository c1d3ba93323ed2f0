#include "widgets/shell/recover_controller.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QWidget>

#include "core/recording/session_file.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {
namespace {

constexpr const char* kAbout = "recover";

/// What is lost, in one line.
QString wordsOf(const recording::Recovery& recovery) {
  QStringList words;
  for (const recording::RecoveredRows& rows : recovery.tables) {
    if (rows.saved == 0 && rows.written.value_or(0) == 0) continue;
    const QString name = QString::fromStdString(rows.table);
    words << (rows.written
                  ? RecoverController::tr("%1 of %2 rows %3").arg(rows.saved).arg(*rows.written).arg(name)
                  : RecoverController::tr("%1 rows %2").arg(rows.saved).arg(name));
  }
  return words.join(", ");
}

}  // namespace

RecoverController::RecoverController(MessageBar& faults, MessageBar& news, SessionLink& link, QObject* parent)
    : QObject(parent), faults_(faults), news_(news), link_(link) {
  connect(&link, &SessionLink::damaged, this, &RecoverController::offer);
  connect(&job_, &Job::progressed, this,
          [this](double, const QString& doing) { news_.setText(tr("Recovering: %1").arg(doing)); });
  connect(&job_, &Job::failed, this, [this](const QString& why) {
    news_.hide();
    faults_.showMessage(why, kAbout);
  });
}

void RecoverController::offer(const QString& file, const QString& why) {
  news_.showNews(why, {{tr("Recover…"), [this, file] { askNew(file); }}});
}

void RecoverController::askDamaged() {
  auto* dialog = new QFileDialog(qobject_cast<QWidget*>(parent()), tr("Damaged session"), QString(),
                                 tr("Sessions (*%1);;All files (*)").arg(recording::kSessionSuffix));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, &RecoverController::askNew);
  dialog->open();
}

void RecoverController::askNew(const QString& damaged) {
  const QFileInfo info(damaged);
  const QString name =
      info.dir().filePath(info.completeBaseName() + "-recovered" + recording::kSessionSuffix);
  auto* dialog = new QFileDialog(qobject_cast<QWidget*>(parent()), tr("Save what is readable as"), name,
                                 tr("Sessions (*%1)").arg(recording::kSessionSuffix));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QString(recording::kSessionSuffix).mid(1));
  connect(dialog, &QFileDialog::fileSelected, this,
          [this, damaged](const QString& saved) { recover(damaged, saved); });
  dialog->open();
}

/// Whether this window records the file: reading it beside SQLite would release the recorder's locks (POSIX).
bool RecoverController::isRecorded(const QString& file) const {
  const auto recorder = link_.recording() ? link_.runner()->recorder() : nullptr;
  return recorder && QFileInfo(QString::fromStdString(recorder->path().string())) == QFileInfo(file);
}

void RecoverController::askRobot(const QString& damaged, const QString& saved) {
  news_.showNews(
      tr("The robot of %1 is lost. Its robot file is needed to save the rest").arg(damaged),
      {{tr("Robot file…"), [this, damaged, saved] {
          auto* dialog = new QFileDialog(qobject_cast<QWidget*>(parent()), tr("Robot of the session"),
                                         QString(), tr("Robot files (*.yaml);;All files (*)"));
          dialog->setAttribute(Qt::WA_DeleteOnClose);
          dialog->setFileMode(QFileDialog::ExistingFile);
          connect(dialog, &QFileDialog::fileSelected, this,
                  [this, damaged, saved](const QString& robot) { recover(damaged, saved, robot); });
          dialog->open();
        }}});
}

void RecoverController::recover(const QString& damaged, const QString& saved, const QString& robot) {
  if (job_.busy()) return;
  if (QFileInfo(damaged) == QFileInfo(saved))
    return faults_.showMessage(tr("%1 is the damaged file. Choose another name").arg(saved), kAbout);
  if (isRecorded(damaged))
    return faults_.showMessage(tr("%1 is under recording. Stop the recording first").arg(damaged), kAbout);
  news_.showNews(tr("Recovering %1").arg(damaged), {{tr("Cancel"), [this] { job_.cancel(); }}});
  job_.start(
      [damaged, saved, robot](base::Progress& progress) -> Outcome {
        try {
          return recording::recoverSession(damaged.toStdString(), saved.toStdString(),
                                           recording::recoverOptions(robot.toStdString()), &progress);
        } catch (const base::InputError& error) {
          if (!recording::lacksRobot(error)) throw;
          return std::nullopt;
        }
      },
      [this, damaged, saved](const Outcome& outcome) {
        if (outcome)
          show(*outcome, damaged, saved);
        else
          askRobot(damaged, saved);
      });
}

void RecoverController::show(const recording::Recovery& recovery, const QString& damaged,
                             const QString& saved) {
  if (recovery.saved() == 0) {
    news_.hide();
    return faults_.showMessage(tr("%1 has nothing to save").arg(damaged), kAbout);
  }
  faults_.hide();
  link_.open(SourceChoice::ofFile(saved));
  const QString words = recovery.whole() ? tr("%1 was whole: %2").arg(damaged, wordsOf(recovery))
                                         : tr("Recovered into %1: %2").arg(saved, wordsOf(recovery));
  news_.showNews(words, {});
}

}  // namespace capstan::widgets
