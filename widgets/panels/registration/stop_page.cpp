#include "widgets/panels/registration/stop_page.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVariant>

#include "core/base/units.h"
#include "widgets/panels/registration/drive_bar.h"

namespace capstan::widgets {

namespace {

QString inUnits(const robot::Joint& joint, double value, bool sign) {
  const bool turns = joint.type == robot::JointType::kRevolute;
  const double shown = base::degreesOrMillimetres(value, turns);
  const QString number = QString::number(std::abs(shown), 'f', 2);
  const QString minus = shown < -0.005 ? QString("−") : sign && shown > 0.005 ? QString("+") : QString(" ");
  return QString("%1 %2").arg(minus + number, 8).arg(turns ? "deg" : "mm ");
}

}  // namespace

StopPage::StopPage(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(18);
  grid->setVerticalSpacing(8);
  advice_ = new QLabel;
  advice_->setWordWrap(true);
  grid->addWidget(advice_, 0, 0, 1, 5);
  constexpr std::array<const char*, 4> kHeads = {"joint", "position", "from the stop", ""};
  for (int column = 0; column < 4; ++column) {
    auto* head = new QLabel(kHeads[static_cast<std::size_t>(column)]);
    head->setFont(textFont(9.5));
    head->setEnabled(false);
    grid->addWidget(head, 1, column, column == 0 || column == 3 ? Qt::AlignLeft : Qt::AlignRight);
    for (int row = 0; row < 3; ++row) {
      auto* cell = cells_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = new QLabel;
      cell->setFont(column == 0 || column == 3 ? textFont(11.0) : numberFont(11.0));
      grid->addWidget(cell, 2 + row, column, column == 0 || column == 3 ? Qt::AlignLeft : Qt::AlignRight);
    }
  }
  grid->setColumnStretch(4, 1);
  rest_ = new QProgressBar;
  rest_->setTextVisible(false);
  rest_->setMaximumHeight(8);
  grid->addWidget(rest_, 5, 0, 1, 5);
  state_ = new QLabel;
  state_->setFont(textFont(10.5, true));
  grid->addWidget(state_, 6, 0, 1, 5);
  override_ = new QCheckBox("The arm is at a known pose: use the encoders although it is not at the stop");
  grid->addWidget(override_, 7, 0, 1, 5);
  commands_ = new DriveBar;
  commands_->hide();
  grid->addWidget(commands_, 8, 0, 1, 5);
  drive_ = new QPushButton("Drive to the hard stop");
  collect_ = new QPushButton("Collect frames");
  collect_->setProperty("primary", true);
  auto* row = new QHBoxLayout;
  row->addWidget(drive_);
  row->addStretch(1);
  row->addWidget(collect_);
  grid->setRowStretch(9, 1);
  grid->addLayout(row, 10, 0, 1, 5);
  connect(drive_, &QPushButton::clicked, this, &StopPage::driveRequested);
  connect(override_, &QCheckBox::toggled, this, &StopPage::overrideChanged);
  connect(collect_, &QPushButton::clicked, this, &StopPage::collectRequested);
  setDrivable(false);
}

void StopPage::setTheme(const Theme& theme) {
  theme_ = theme;
  commands_->setTheme(theme);
}

void StopPage::setCommandable(bool commandable) { commands_->setVisible(commandable); }

void StopPage::setDrivable(bool drivable) {
  drivable_ = drivable;
  drive_->setVisible(drivable);
  override_->setVisible(!drivable);
  override_->setChecked(false);
  advice_->setText(
      drivable ? "At the hard stop the encoders are exact, so the marker's position in the robot's frame is "
                 "known. Drive the arm there and let it come to rest in view of both cameras."
               : "At the hard stop the encoders are exact, so the marker's position in the robot's frame is "
                 "known. Move the arm against its stops by hand (in a recording: play to where it is there) "
                 "and let it rest in view of both cameras.");
}

void StopPage::setEnded(bool ended) {
  ended_ = ended;
  drive_->setEnabled(!ended);
  drive_->setToolTip(ended ? "The session has ended: begin it again (Space)" : QString());
  if (ended) collect_->setEnabled(false);
}

void StopPage::showGuide(const registration::RegistrationGuide& guide) {
  const auto& arrival = guide.arrival();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& joint = guide.robot().joints[i];
    const double distance = arrival.distance(static_cast<int>(i));
    cells_[i][0]->setText(QString::fromStdString(joint.name));
    cells_[i][1]->setText(inUnits(joint, joint.homing + distance, false));
    cells_[i][2]->setText(inUnits(joint, distance, true));
    cells_[i][3]->setText(arrival.near[i] ? "✓ at the stop" : "on its way");
    restyle(*cells_[i][3], arrival.near[i] ? QString("color:%1; font-weight:bold;").arg(theme_.text.name())
                                           : QString("color:%1;").arg(theme_.muted.name()));
  }
  const double wanted = registration::RegistrationGuide::kRestTime;
  rest_->setRange(0, 100);
  rest_->setValue(static_cast<int>(100.0 * std::clamp(arrival.rest / wanted, 0.0, 1.0)));
  const bool can = guide.canCollect();
  const bool near = arrival.near[0] && arrival.near[1] && arrival.near[2];
  state_->setText(arrival.arrived ? "Arrived: at rest at the hard stop."
                  : near          ? QString("At the stop, waiting for %1 s of rest.").arg(wanted)
                  : can
                      ? QString("At rest, %1.").arg("not at the stop: the encoders' error adds to the result")
                      : QString("Not at the hard stop yet."));
  collect_->setEnabled(can && !ended_);
}

}  // namespace capstan::widgets
