#include "widgets/panels/status/status_line.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "core/tracking/side_text.h"
#include "widgets/panels/status/elided_label.h"

namespace capstan::widgets {

namespace {

using live::RunState;
using recording::RecorderState;
using tracking::Gate;
using tracking::HealthCheck;
using tracking::HealthVerdict;

constexpr double kBehind = 0.9;        ///< below this share of the requested speed a warning is shown
constexpr qint64 kDiskPeriod = 10000;  ///< period of checking the disk [ms]

constexpr double kSoonFull = 300.0;  ///< warning if the reserve is reached in less time [s]

QString sizeText(std::uint64_t bytes) { return QString::fromStdString(recording::sizeText(bytes)); }

/// "NIS of shoulder 5.50 FAIL", as the panel of the estimator's health has it.
QString textOf(const HealthCheck& check) {
  const auto verdict = base::nameOf(check.verdict);
  return QStringLiteral("%1 %2 %3")
      .arg(QString::fromStdString(check.name), QString::fromStdString(check.value),
           QString::fromUtf8(verdict.data(), static_cast<int>(verdict.size())));
}

QString minutesText(double seconds) {
  const double minutes = seconds / 60.0;
  return minutes < 1.0 ? QObject::tr("under 1 min left")
                       : QObject::tr("%1 min left").arg(minutes, 0, 'f', minutes < 10.0 ? 1 : 0);
}

}  // namespace

QString faultWords(tracking::MotorFault fault) {
  switch (fault) {
    case tracking::MotorFault::kLost:
      return QObject::tr("lost");
    case tracking::MotorFault::kFrozen:
      return QObject::tr("frozen");
    case tracking::MotorFault::kDeclared:
      return QObject::tr("failed");
    case tracking::MotorFault::kNone:
      break;
  }
  return {};
}

QString clockText(double seconds) {
  const auto whole = static_cast<long>(std::max(0.0, std::floor(seconds)));
  const QString tail = QStringLiteral("%1:%2")
                           .arg(whole / 60 % 60, 2, 10, QLatin1Char('0'))
                           .arg(whole % 60, 2, 10, QLatin1Char('0'));
  return whole < 3600 ? tail : QStringLiteral("%1:%2").arg(whole / 3600).arg(tail);
}

StatusLine::StatusLine(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 2, 8, 2);
  row->setSpacing(0);
  for (std::size_t i = 0; i < kParts; ++i) {
    labels_[i] = i == kSides ? new ElidedLabel : new QLabel;  // a reason may be long
    for (auto* label : {dots_[i] = new QLabel(QStringLiteral(" · ")), labels_[i]}) {
      label->setFont(numberFont(10.0));
      row->addWidget(label);
    }
    if (i == kTransmission) row->addWidget(remedies_ = new QToolButton);
  }
  remedies_->setObjectName("remedies");
  remedies_->setText(tr("Identify or diagnose ▾"));
  remedies_->setStyleSheet(
      "QToolButton { border: 1px solid palette(mid); border-radius: 3px; padding: 1px 6px; margin: 0 4px 0 "
      "8px; }"
      "QToolButton:focus { border-color: palette(highlight); }"
      "QToolButton::menu-indicator { image: none; }");
  remedies_->setToolTip(tr("Find which parameter of the robot file is wrong"));
  remedies_->setPopupMode(QToolButton::InstantPopup);
  remedies_->hide();
  row->addStretch(1);
  labels_[kMotors]->setToolTip(tr("An encoder that failed: its joint is estimated from the cameras alone"));
  labels_[kLag]->setToolTip(tr("From exposure to arrival of the newest camera sample"));
  labels_[kRescues]->setToolTip(tr("Cholesky down-dates that fell back to a safe path"));
  clear();
}

void StatusLine::setFolder(const QString& folder) {
  folder_ = folder;
  disk_backlog_.invalidate();
}

void StatusLine::setRobot(const QString& words, const QString& changes) {
  set(kRobot, words.isEmpty() ? QString() : tr("robot %1").arg(words));
  labels_[kRobot]->setToolTip(changes.isEmpty() ? tr("The filter uses the source's own robot") : changes);
}

void StatusLine::setCommands(const QString& words, bool loud) {
  set(kCommands, words, loud ? Tone::kFault : Tone::kPlain);
}

void StatusLine::setSource(const QString& source) { set(kSource, source); }

void StatusLine::setRemedies(const QList<QAction*>& remedies) {
  auto* menu = new QMenu(remedies_);
  menu->addActions(remedies);
  remedies_->setMenu(menu);
}

void StatusLine::setTheme(const Theme& theme) {
  theme_ = theme;
  for (int part = 0; part < kParts; ++part)
    set(static_cast<Part>(part), labels_[static_cast<std::size_t>(part)]->text(),
        tones_[static_cast<std::size_t>(part)]);
}

void StatusLine::set(Part part, const QString& text, Tone tone) {
  auto* label = labels_[part];
  tones_[part] = tone;
  label->setText(text);
  separate();
  QPalette palette = label->palette();
  const QColor colour = tone == Tone::kPlain     ? theme_.text
                        : tone == Tone::kGood    ? theme_.text
                        : tone == Tone::kWarning ? theme_.inkOf(theme_.warning)
                                                 : theme_.inkOf(theme_.fault);
  palette.setColor(QPalette::WindowText, colour);
  label->setPalette(palette);
  QFont font = label->font();
  font.setBold(tone == Tone::kWarning || tone == Tone::kFault);
  label->setFont(font);
}

void StatusLine::separate() {
  std::array<bool, kParts> seen{};
  int needed = layout()->contentsMargins().left() + layout()->contentsMargins().right();
  if (!remedies_->isHidden()) needed += remedies_->sizeHint().width();
  for (std::size_t i = 0; i < kParts; ++i)
    if ((seen[i] = !labels_[i]->text().isEmpty()))
      needed += labels_[i]->sizeHint().width() + dots_[i]->sizeHint().width();
  for (const Part part : {kMotor, kFrames, kLag, kRescues, kDisk, kSource}) {
    if (needed <= width()) break;
    if (!seen[part] || tones_[part] == Tone::kWarning || tones_[part] == Tone::kFault) continue;
    seen[part] = false;
    needed -= labels_[part]->sizeHint().width() + dots_[part]->sizeHint().width();
  }
  bool first = true;
  for (std::size_t i = 0; i < kParts; ++i) {
    labels_[i]->setVisible(seen[i]);
    dots_[i]->setVisible(seen[i] && !first);
    first = first && !seen[i];
  }
}

void StatusLine::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  separate();
}

bool StatusLine::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip)
    setToolTip(details_.isEmpty() ? text() : text() + QStringLiteral("\n\n") + details_);
  return QWidget::event(event);
}

QSize StatusLine::minimumSizeHint() const {
  constexpr int kLeastWidth = 200;  // [px] the rest is in the tool tip
  return {kLeastWidth, QWidget::minimumSizeHint().height()};
}

void StatusLine::clear() {
  for (int part = 0; part < kParts; ++part) set(static_cast<Part>(part), {});
  tips_ = false;
  remedies_->hide();
  set(kState, tr("no source"));
}

void StatusLine::showSnapshot(const tracking::Snapshot& snapshot) {
  const bool cameras = snapshot.camera_samples > 0;
  set(kLag, cameras ? QStringLiteral("lag %1 ms").arg(snapshot.latency * 1e3, 3, 'f', 0) : QString());
  tips_ = tracking::tipAlone(snapshot);
  const QString reason = QString::fromStdString(std::string(tracking::gateWords(snapshot)));
  if (snapshot.gate == Gate::kOpen)
    set(kGate, tr("gate open"), Tone::kGood);
  else
    set(kGate, tr("gate shut: %1").arg(reason), cameras ? Tone::kWarning : Tone::kPlain);
  showMotors(snapshot);
  showTransmission(snapshot);
  QString troubles = QStringLiteral("rescues %1").arg(static_cast<qulonglong>(snapshot.rescues));
  if (snapshot.motor_refused > 0)
    troubles += tr(", %1 motor samples refused").arg(static_cast<qulonglong>(snapshot.motor_refused));
  if (snapshot.motor_stray > 0)
    troubles += tr(", %1 stray motor positions").arg(static_cast<qulonglong>(snapshot.motor_stray));
  set(kRescues, troubles,
      snapshot.rescues + snapshot.motor_refused + snapshot.motor_stray > 0 ? Tone::kWarning : Tone::kPlain);
}

void StatusLine::showTransmission(const tracking::Snapshot& snapshot) {
  const std::string carried = tracking::shortTextOf(snapshot.transmission);
  set(kTransmission, QString::fromStdString(carried), Tone::kWarning);
  QStringList explained;
  for (const std::string& line : tracking::linesOf(snapshot.transmission))
    explained << QString::fromStdString(line);
  for (const std::string& remedy : tracking::remediesOf(snapshot.transmission, delay_field_))
    explained << QString::fromStdString(remedy);
  labels_[kTransmission]->setToolTip(explained.join(QLatin1Char('\n')));
  offerRemedies();
}

void StatusLine::showHealth(const std::vector<HealthCheck>& checks) {
  const std::vector<HealthCheck> nis = tracking::nisChecksOf(checks);
  const HealthVerdict verdict = tracking::worstOf(nis);
  const bool measured = std::ranges::any_of(nis, [](const auto& check) { return !check.value.empty(); });
  if (!measured)
    set(kNis, {});
  else if (verdict == HealthVerdict::kUnknown)
    set(kNis, tr("NIS not judged yet"));
  else
    set(kNis, textOf(*std::ranges::max_element(nis, {}, &HealthCheck::verdict)),
        verdict == HealthVerdict::kFail       ? Tone::kFault
        : verdict == HealthVerdict::kCautious ? Tone::kPlain
                                              : Tone::kGood);
  QStringList explained = {
      tr("Normalised innovation squared of every joint, since the errors count; 1 where σ "
         "is right (Estimator health, Ctrl+7)")};
  for (const HealthCheck& check : nis)
    explained << (textOf(check) + QLatin1Char(' ') + QString::fromStdString(check.advice)).trimmed();
  labels_[kNis]->setToolTip(explained.join(QLatin1Char('\n')));
  offerRemedies();
}

void StatusLine::offerRemedies() {
  const bool wrong = tones_[kNis] == Tone::kFault || !labels_[kTransmission]->text().isEmpty();
  remedies_->setVisible(wrong && remedies_->menu());
}

void StatusLine::showMotors(const tracking::Snapshot& snapshot) {
  QStringList failed;
  for (std::size_t i = 0; i < snapshot.motor_failed.size(); ++i)
    if (snapshot.motor_failed[i] != tracking::MotorFault::kNone)
      failed << tr("motor %1 %2").arg(i + 1).arg(faultWords(snapshot.motor_failed[i]));
  set(kMotors, failed.join(QStringLiteral(", ")), Tone::kFault);
}

void StatusLine::showStatus(const live::RunStatus& status, double recorded_seconds) {
  delay_field_ = status.sides.empty() ? tracking::DelayField::kOptions : tracking::DelayField::kLiveSetup;
  const bool live = !status.sides.empty() && status.state == RunState::kRunning;
  const QString state = QString::fromStdString(std::string(base::nameOf(status.state)));
  set(kState, live ? tr("live") : state, status.state == RunState::kFailed ? Tone::kFault : Tone::kPlain);
  const bool behind = !live && status.state == RunState::kRunning && status.real_time_factor > 0.0 &&
                      status.real_time_factor < kBehind * status.speed;
  set(kSpeed, behind ? tr("only ×%1").arg(status.real_time_factor, 0, 'f', 1) : QString(), Tone::kWarning);
  set(kMotor, QStringLiteral("%1 Hz").arg(status.motor_rate, 4, 'f', 0));
  set(kFrames, (tips_ ? tr("%1 tips/s") : tr("%1 fps")).arg(status.frame_rate, 4, 'f', 1));
  labels_[kRecording]->setToolTip(QString::fromStdString(status.recording));
  if (status.recorder)
    showRecorder(*status.recorder, recorded_seconds);
  else
    set(kRecording, {});
  showSides(status.sides);
  showOcclusion(status);
  showDisk(status.recorder && status.recorder->state == RecorderState::kRecording ? &*status.recorder
                                                                                  : nullptr);
}

void StatusLine::showRecorder(const recording::RecorderStats& recorder, double recorded_seconds) {
  const QString clock = clockText(recorded_seconds);
  if (recorder.state == RecorderState::kFailed)
    set(kRecording, tr("recording failed"), Tone::kFault);
  else if (recorder.state == RecorderState::kClosed)
    set(kRecording, tr("recording closed"));
  else if (recorder.dropped > 0)
    set(kRecording, tr("● REC %1, %2 dropped").arg(clock).arg(static_cast<qulonglong>(recorder.dropped)),
        Tone::kFault);
  else
    set(kRecording, tr("● REC %1").arg(clock), Tone::kWarning);
}

/// Shows a live source's sides that need attention; numbers are in the tool tip.
void StatusLine::showSides(const std::vector<tracking::SideStatus>& sides) {
  QStringList words, details;
  bool fault = false;
  for (const tracking::SideStatus& side : sides) {
    const QString word = QString::fromStdString(tracking::shortTextOf(side)).simplified();
    tracking::needsAttention(side) ? words.prepend(word) : words.append(word);
    details << QString::fromStdString(tracking::textOf(side));
    fault = fault || tracking::needsAttention(side);
  }
  words.removeAll(QString());
  details_ = details.join(QLatin1Char('\n'));
  set(kSides, words.join(QStringLiteral(", ")), fault ? Tone::kFault : Tone::kPlain);
  labels_[kSides]->setToolTip(details_);
}

/// Shows which cameras the user blocks; in a recording this is not part of the recorded data.
void StatusLine::showOcclusion(const live::RunStatus& status) {
  QString what;
  if (status.occlusion.percentage > 0.0)
    what = tr("occlusion %1 %").arg(status.occlusion.percentage, 0, 'f', 0);
  else if (status.blocked[0] || status.blocked[1])
    what = status.blocked[0] && status.blocked[1] ? tr("both blocked")
           : status.blocked[0]                    ? tr("left blocked")
                                                  : tr("right blocked");
  set(kOcclusion, status.occlusion_added ? tr("%1, added to the recording").arg(what) : what, Tone::kWarning);
}

/// Shows the disk of the running recording, else of the folder for the next one.
void StatusLine::showDisk(const recording::RecorderStats* recording) {
  if (recording) {
    disk_backlog_.invalidate();
    if (!recording->free_known) return set(kDisk, tr("disk: free space not known"));
    return setDisk({recording->free_bytes, recording->reserve_bytes, 0}, recording->time_left);
  }
  if (disk_backlog_.isValid() && disk_backlog_.elapsed() < kDiskPeriod) return;
  disk_backlog_.start();
  const recording::DiskSpace space =
      folder_.isEmpty() ? recording::DiskSpace{} : recording::diskSpaceAt(folder_.toStdString());
  if (space.size == 0) return set(kDisk, {});
  setDisk(space, 0.0);
}

void StatusLine::setDisk(const recording::DiskSpace& space, double time_left) {
  QString text = tr("disk %1, reserve %2").arg(sizeText(space.free), sizeText(space.reserve));
  if (time_left > 0.0) text += QStringLiteral(", ") + minutesText(time_left);
  const bool full = space.free < space.reserve;
  const bool soon = time_left > 0.0 && time_left < kSoonFull;
  set(kDisk, text, full ? Tone::kFault : soon ? Tone::kWarning : Tone::kPlain);
  labels_[kDisk]->setToolTip(
      tr("Free space for recordings in %1. A recording stops, complete, when only the reserve is free.")
          .arg(folder_));
}

QString StatusLine::text() const {
  QStringList parts;
  for (const auto* label : labels_)
    if (!label->text().isEmpty()) parts << label->text();
  return parts.join(QStringLiteral(" · "));
}

}  // namespace capstan::widgets
