#include "widgets/panels/diagnosis/recording_picker.h"
#include "core/recording/recording_kinds.h"

#include <QBoxLayout>
#include <QFileInfo>
#include <QMenu>
#include <QToolButton>

namespace capstan::widgets {

RecordingPicker::RecordingPicker(QWidget* parent)
    : FilePicker(
          {"recordings", tr("recordings"), tr("recordings"), tr("Recordings of one robot"),
           tr("Recordings (%1);;All files (*)").arg(QString::fromStdString(recording::recordingPatterns()))},
          parent),
      offer_(new QToolButton) {
  offer_->setObjectName("offered");
  auto* robots = new QMenu(this);
  robots->addAction(tr("the recordings' own, or the left RAVEN-II"), this, [this] { setRobot({}); });
  robots->addAction(tr("robot file…"), this, &RecordingPicker::askRobot);
  robot_ = menuButton("nominal_robot", tr("The nominal robot"), robots);
  auto* units = new QMenu(this);
  units->addAction(tr("SI units"), this, [this] { setUnits({}); });
  units->addAction(tr("units of the open recording"), this, [this] { setUnits(offered_read_as_); });
  units_ = menuButton("units", tr("Units in which tables are read"), units);
  row()->addWidget(offer_);
  row()->addWidget(units_);
  row()->addWidget(robot_);
  connect(offer_, &QToolButton::clicked, this, &RecordingPicker::takeOffered);
  refresh();
}

void RecordingPicker::setChoice(const DiagnosisChoice& choice) {
  choice_ = choice;
  refresh();
}

void RecordingPicker::setRobot(const QString& robot) {
  if (robot == choice_.robot) return;
  choice_.robot = robot;
  refresh();
  Q_EMIT changed();
}

void RecordingPicker::setUnits(const QString& read_as) {
  if (read_as == choice_.read_as) return;
  choice_.read_as = read_as;
  refresh();
  Q_EMIT changed();
}

void RecordingPicker::offer(const QString& path, const QString& words, const QString& read_as) {
  offered_ = path;
  offered_read_as_ = read_as;
  offer_->setText(words);
  refresh();
}

void RecordingPicker::takeOffered() {
  if (offered_.isEmpty()) return;
  choice_.read_as = offered_read_as_;
  setFiles({QFileInfo(offered_).absoluteFilePath()});
}

void RecordingPicker::askRobot() {
  const QStringList beside = choice_.robot.isEmpty() ? choice_.recordings : QStringList{choice_.robot};
  connect(ask(tr("The nominal robot"), beside, tr("Robot files (*.yaml);;All files (*)"),
              QFileDialog::ExistingFile),
          &QFileDialog::fileSelected, this,
          [this](const QString& path) { setRobot(QFileInfo(path).absoluteFilePath()); });
}

void RecordingPicker::refresh() {
  FilePicker::refresh();
  offer_->setVisible(!offered_.isEmpty() && choice_.recordings != QStringList{offered_});
  offer_->setToolTip(tr("Choose %1 alone, in place of the recordings above, for Diagnose (F5)")
                         .arg(QFileInfo(offered_).fileName()));
  units_->setVisible(!choice_.read_as.isEmpty() || !offered_read_as_.isEmpty());
  units_->setText((choice_.read_as.isEmpty() ? tr("SI units") : tr("own units")) + QStringLiteral(" ▾"));
  units_->setToolTip(choice_.read_as.isEmpty() ? tr("Tables are read in SI units")
                                               : tr("Tables are read as %1").arg(choice_.read_as));
  robot_->setText((choice_.robot.isEmpty() ? tr("own robot") : QFileInfo(choice_.robot).completeBaseName()) +
                  QStringLiteral(" ▾"));
}

}  // namespace capstan::widgets
