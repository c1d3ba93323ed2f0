#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <array>
#include <optional>
#include <vector>

#include "core/live/runner.h"
#include "core/recording/disk_space.h"
#include "core/tracking/health.h"
#include "core/tracking/snapshot.h"
#include "core/tracking/transmission_text.h"
#include "widgets/figures/theme.h"

class QAction;
class QLabel;
class QToolButton;

namespace capstan::widgets {

/// One line about the session: the recording, robot, rates, lag, gate, occlusion, failed motor encoders,
/// consistency, rescues, recording, disk. A state that is not good has the warning or fault colour and a
/// word. If the window is too narrow, parts that need no action are shown only in the tool tip.
class StatusLine : public QWidget {
  Q_OBJECT
 public:
  explicit StatusLine(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showSnapshot(const tracking::Snapshot& snapshot);
  /// Shows the NIS of the joint with the worst verdict, as the panel of the estimator's health judges it.
  void showHealth(const std::vector<tracking::HealthCheck>& checks);
  void showStatus(const live::RunStatus& status, double recorded_seconds);
  void clear();
  /// Sets the robot that the filter uses; `changes`: its differences from the robot file.
  void setRobot(const QString& words, const QString& changes);
  /// Sets the name of the replayed source, as "recording trial.capstan"; empty for a simulation.
  void setSource(const QString& source);
  /// Sets the state of commands to the real robot; empty: it cannot be commanded. `loud`: they are armed, or
  /// were stopped.
  void setCommands(const QString& words, bool loud);
  /// Sets the actions of a button beside the NIS. It is shown while the NIS fails or the filter
  /// estimates a transmission error.
  void setRemedies(const QList<QAction*>& remedies);
  /// Sets the folder of recordings, whose disk space is shown.
  void setFolder(const QString& folder);
  /// The whole line, parts joined by " · ".
  QString text() const;
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  enum Part {
    kSource,
    kState,
    kSides,
    kCommands,
    kRobot,
    kSpeed,
    kMotor,
    kFrames,
    kLag,
    kGate,
    kOcclusion,
    kMotors,
    kNis,
    kTransmission,
    kRescues,
    kRecording,
    kDisk,
    kParts
  };
  enum class Tone { kPlain, kGood, kWarning, kFault };
  void showSides(const std::vector<tracking::SideStatus>& sides);
  void showTransmission(const tracking::Snapshot& snapshot);
  void offerRemedies();
  void showMotors(const tracking::Snapshot& snapshot);
  void showRecorder(const recording::RecorderStats& recorder, double recorded_seconds);
  void showOcclusion(const live::RunStatus& status);
  void showDisk(const recording::RecorderStats* recording);
  void setDisk(const recording::DiskSpace& space, double time_left);
  void separate();
  void set(Part part, const QString& text, Tone tone = Tone::kPlain);

  Theme theme_ = Theme::dark();
  QString details_;  ///< numbers of the sides of a live source, a line each
  std::array<QLabel*, kParts> labels_{};
  std::array<QLabel*, kParts> dots_{};  ///< dot before each visible part but the first
  std::array<Tone, kParts> tones_{};
  QToolButton* remedies_;
  QString folder_;
  bool tips_ = false;  ///< the camera samples are tip positions, not images
  tracking::DelayField delay_field_ = tracking::DelayField::kOptions;
  QElapsedTimer disk_backlog_;
};

/// Word for a fault of an encoder: "lost", "frozen" or "failed".
QString faultWords(tracking::MotorFault fault);

/// Time as minutes and seconds, 03:12, or 1:03:12 from one hour on.
QString clockText(double seconds);

}  // namespace capstan::widgets
