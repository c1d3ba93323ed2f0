#include "widgets/panels/occlusion/occlusion_panel.h"

#include <QBoxLayout>
#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <string_view>

#include "widgets/panels/occlusion/occlusion_timeline.h"

namespace capstan::widgets {

namespace {

constexpr std::array kShares = {0, 10, 20, 40, 60, 80};  // [%] UKF paper, section V-D

QString text(std::string_view view) { return QString::fromUtf8(view.data(), static_cast<int>(view.size())); }

}  // namespace

OcclusionPanel::OcclusionPanel(QWidget* parent) : QWidget(parent), keys_(new HoldKeys(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(6);
  addBlockButtons(column);
  addSchedule(column);
  now_ = new QLabel;
  now_->setFont(textFont(10.5, true));
  now_->setWordWrap(true);
  now_->setAccessibleName("what the filter observes");
  reason_ = new QLabel;
  reason_->setWordWrap(true);
  column->addWidget(now_);
  column->addWidget(reason_);
  reason_->setMinimumHeight(2 * reason_->fontMetrics().lineSpacing());  // so that nothing moves as it changes
  reason_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  faults_.fill(vision::MarkerFault::kNoImage);
  setTheme(theme_);
}

void OcclusionPanel::addBlockButtons(QVBoxLayout* column) {
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  constexpr std::array<const char*, 3> kNames = {"Left", "Right", "Both"};
  constexpr std::array<int, 3> kKeys = {Qt::Key_L, Qt::Key_K, Qt::Key_B};
  for (int i = 0; i < 3; ++i) {
    const auto which = static_cast<Which>(i);
    const auto index = static_cast<std::size_t>(i);
    auto* button = buttons_[index] = new QPushButton(kNames[index]);
    button->setCheckable(true);
    button->setMinimumWidth(40);
    button->setToolTip(QString("Block now (%1). Click: until clicked again; hold: as long as held.")
                           .arg(QChar(kKeys[index])));
    button->setAccessibleName(QString("block %1").arg(QString(kNames[index]).toLower()));
    connect(button, &QPushButton::pressed, this, [this, which] { press(which); });
    connect(button, &QPushButton::released, this, [this, which] { release(which); });
    keys_->bind(kKeys[index], [this, which](bool pressed) { pressed ? press(which) : release(which); });
    row->addWidget(button, 1);
  }
  column->addLayout(row);
}

void OcclusionPanel::addSchedule(QVBoxLayout* column) {
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  shares_ = new QButtonGroup(this);
  for (const int share : kShares) {
    auto* button = new QPushButton(share == 0 ? QString("off") : QString::number(share));
    button->setCheckable(true);
    button->setChecked(share == 0);
    button->setMinimumWidth(24);
    button->setProperty("segment", true);
    button->setToolTip(share == 0 ? QString("No schedule")
                                  : QString("Cameras blocked %1 % of the time, at equal spacing").arg(share));
    shares_->addButton(button, share);
    row->addWidget(button, 1);
  }
  row->addWidget(new QLabel("%"));
  column->addLayout(row);
  connect(shares_, &QButtonGroup::idClicked, this, [this] { changeSchedule(); });

  auto* line = new QHBoxLayout;
  interval_ = new QDoubleSpinBox;
  interval_->setRange(0.2, 20.0);
  interval_->setSingleStep(0.5);
  interval_->setDecimals(1);
  interval_->setValue(schedule_.interval);
  interval_->setSuffix(" s");
  interval_->setToolTip("Length of each blocked interval");
  connect(interval_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this] { changeSchedule(); });
  schedule_state_ = new QLabel;
  cameras_ = new QComboBox;
  cameras_->setObjectName("cameras");
  cameras_->setAccessibleName("cameras of the schedule");
  cameras_->setToolTip(
      "Cameras that the schedule blocks. With one, the filter may use the ray of the other: "
      "filter options, one camera blocked (Ctrl+9)");
  for (const auto& [which, name] : base::NamesOf<live::BlockedCameras>::value)
    cameras_->addItem(name, static_cast<int>(which));
  connect(cameras_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] { changeSchedule(); });
  line->addWidget(cameras_);
  line->addWidget(new QLabel("for"));
  line->addWidget(interval_);
  line->addStretch(1);
  line->addWidget(schedule_state_);
  column->addLayout(line);
  timeline_ = new OcclusionTimeline;
  column->addWidget(timeline_);
}

void OcclusionPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  timeline_->setTheme(theme);
  setStyleSheet(
      QString("QPushButton[segment=\"true\"] { padding: 3px 2px; }"
              "QPushButton[segment=\"true\"]:checked { background: %1; color: %2; border: 1px solid %1;"
              " border-radius: 3px; font-weight: bold; }")
          .arg(theme.accent.name(), theme.on_accent.name()));
  reason_->setStyleSheet(QString("color: %1").arg(theme.muted.name()));
  schedule_state_->setStyleSheet(QString("color: %1").arg(theme.muted.name()));
  markButtons();
  now_->setText(observation());
  reason_->setText(reason());
}

QString OcclusionPanel::observation() const {
  if (ray_) return "now: observing a single ray";
  if (gate_ != tracking::Gate::kOpen) return "now: observing the motors (q_kin)";
  return tip_alone_ ? QString("now: observing the tip (q_cam)")
                    : QString("now: observing the camera (q_cam)");
}

QString OcclusionPanel::reason() const {
  if (gate_ == tracking::Gate::kOpen)
    return tip_alone_ ? QString("The tip is seen.") : QString("The marker is seen in both images.");
  if (gate_ == tracking::Gate::kUnregistered)
    return "not registered: the marker is seen, the cameras' pose is unknown (Ctrl+R).";
  if (gate_ == tracking::Gate::kExchanged)
    return "left and right camera exchanged: exchange their plugs, or left and right in the live set-up.";
  QString why = text(gate_words_);
  if (tip_alone_ || ray_) return why + ".";
  for (std::size_t side = 0; side < 2; ++side) {
    const bool concerned = gate_ == tracking::Gate::kBothLost ||
                           gate_ == (side == 0 ? tracking::Gate::kLeftLost : tracking::Gate::kRightLost);
    if (concerned && faults_[side] != vision::MarkerFault::kNone) {
      why += ": " + text(base::nameOf(faults_[side]));
      break;
    }
  }
  return why + ".";
}

void OcclusionPanel::showSnapshot(const tracking::Snapshot& snapshot) {
  t_ = snapshot.t;
  timeline_->setNow(t_);
  const std::array<vision::MarkerFault, 2> faults = {snapshot.marker[0].fault, snapshot.marker[1].fault};
  const bool tip_alone = tracking::tipAlone(snapshot);
  if (snapshot.gate == gate_ && faults == faults_ && tip_alone == tip_alone_ && snapshot.ray_used == ray_)
    return;
  gate_ = snapshot.gate;
  gate_words_ = tracking::gateWords(snapshot);
  tip_alone_ = tip_alone;
  ray_ = snapshot.ray_used;
  faults_ = faults;
  now_->setText(observation());
  reason_->setText(reason());
}

/// Whether the schedule blocks its cameras now. Not visible while they are blocked by hand anyway.
bool OcclusionPanel::scheduledNow() const {
  using live::BlockedCameras;
  const std::array<bool, 2> of = {schedule_.cameras != BlockedCameras::kRight,
                                  schedule_.cameras != BlockedCameras::kLeft};
  bool all = true, by_hand = true;
  for (std::size_t side = 0; side < 2; ++side) {
    all = all && (!of[side] || blocked_[side]);
    by_hand = by_hand && (!of[side] || hand_[side]);
  }
  return schedule_.percentage > 0.0 && all && !by_hand;
}

void OcclusionPanel::showBlocked(const std::array<bool, 2>& blocked) {
  blocked_ = blocked;
  markButtons();
  schedule_state_->setText(schedule_.percentage <= 0.0 ? QString()
                           : scheduledNow()            ? QString("blocked")
                                                       : QString("observable"));
}

void OcclusionPanel::setSchedule(const live::OcclusionSchedule& schedule) {
  schedule_ = schedule;
  const QSignalBlocker quiet(interval_), quiet_too(cameras_);
  interval_->setValue(schedule.interval);
  cameras_->setCurrentIndex(cameras_->findData(static_cast<int>(schedule.cameras)));
  if (auto* button = shares_->button(qRound(schedule.percentage))) button->setChecked(true);
  timeline_->setSchedule(schedule_);
}

void OcclusionPanel::beginSession(double t, bool again) {
  if (!again) {
    hand_ = before_ = {};
    setSchedule({0.0, schedule_.interval, t, schedule_.cameras});
  }
  t_ = schedule_.start = t;
  blocked_ = hand_;
  timeline_->setNow(t);
  timeline_->setSchedule(schedule_);
  markButtons();
}

void OcclusionPanel::setBlockable(bool blockable) {
  setEnabled(blockable);
  setToolTip(blockable ? QString() : QString("This source has no cameras to block."));
}

void OcclusionPanel::changeSchedule() {
  schedule_.percentage = std::max(0, shares_->checkedId());
  schedule_.interval = interval_->value();
  schedule_.cameras = static_cast<live::BlockedCameras>(cameras_->currentData().toInt());
  schedule_.start = t_;
  timeline_->setSchedule(schedule_);
  showBlocked(hand_);
  Q_EMIT scheduleChanged(schedule_);
}

void OcclusionPanel::press(Which which) {
  before_ = hand_;
  holds_[which].press();
  std::array<bool, 2> next = hand_;
  if (which == kBoth)
    next.fill(!(hand_[0] && hand_[1]));
  else
    next[which] = !next[which];
  set(next);
}

void OcclusionPanel::release(Which which) {
  if (holds_[which].wasHeld())
    set(before_);
  else
    markButtons();
}

void OcclusionPanel::set(std::array<bool, 2> blocked) {
  const bool changed = blocked != hand_;
  hand_ = blocked;
  markButtons();
  if (changed) Q_EMIT blockChanged(hand_[0], hand_[1]);
}

void OcclusionPanel::markButtons() {
  // A button shows both: pressed by hand, and actually blocked by the schedule.
  const std::array<bool, 2> shut = {hand_[0] || blocked_[0], hand_[1] || blocked_[1]};
  const std::array<bool, 3> on = {hand_[0], hand_[1], hand_[0] && hand_[1]};
  const std::array<bool, 3> lit = {shut[0], shut[1], shut[0] && shut[1]};
  const bool settled = on == marked_on_ && lit == marked_lit_;
  marked_on_ = on;
  marked_lit_ = lit;
  for (std::size_t i = 0; i < 3; ++i) {
    // A checkable button flips itself after released(): set its appearance once the click is through.
    QMetaObject::invokeMethod(
        this, [button = buttons_[i], state = on[i]] { button->setChecked(state); }, Qt::QueuedConnection);
    if (settled) continue;
    buttons_[i]->setStyleSheet(lit[i] ? QString("background: %1; color: #15181c; font-weight: bold; border: "
                                                "1px solid %1; border-radius: 3px; padding: 4px;")
                                            .arg(theme_.warning.name())
                                      : QString());
  }
}

}  // namespace capstan::widgets
