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
  row()->addWidget(offer_);
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

void RecordingPicker::offer(const QString& path, const QString& words) {
  offered_ = path;
  offer_->setText(words);
  refresh();
}

void RecordingPicker::takeOffered() {
  if (!offered_.isEmpty()) setFiles({QFileInfo(offered_).absoluteFilePath()});
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
  offer_->setToolTip(tr("Diagnose %1 alone").arg(QFileInfo(offered_).fileName()));
  robot_->setText((choice_.robot.isEmpty() ? tr("own robot") : QFileInfo(choice_.robot).completeBaseName()) +
                  QStringLiteral(" ▾"));
}

}  // namespace capstan::widgets
