#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <array>
#include <optional>

#include "core/live/runner.h"
#include "core/recording/disk_space.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"

class QAction;
class QLabel;
class QToolButton;

namespace capstan::widgets {

/// One line about the session: the recording, robot, rates, lag, gate, occlusion, motor encoders that failed,
/// consistency, rescues, recording, disk. A verdict that is not good carries the warning or fault colour and
/// says it in a word. Where the window is too narrow, parts that ask for nothing are left to the tool tip.
class StatusLine : public QWidget {
  Q_OBJECT
 public:
  explicit StatusLine(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showSnapshot(const tracking::Snapshot& snapshot);
  void showStatus(const live::RunStatus& status, double recorded_seconds);
  void clear();
  /// Which robot the filter takes the arm for; `changes`: what it has other than the robot file.
  void setRobot(const QString& words, const QString& changes);
  /// What is replayed, as "recording trial.capstan"; empty for a simulation.
  void setSource(const QString& source);
  /// What a button beside the NIS offers while it fails, or while the filter carries a transmission error.
  void setRemedies(const QList<QAction*>& remedies);
  /// Whose disk is shown: the folder of recordings.
  void setFolder(const QString& folder);
  /// The whole line, parts joined by " · ".
  QString text() const;
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  enum Part {
    kSource,
    kState,
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
  void showNis(const tracking::Snapshot& snapshot);
  void showMotors(const tracking::Snapshot& snapshot);
  void showRecorder(const recording::RecorderStats& recorder, double recorded_seconds);
  void showOcclusion(const live::RunStatus& status);
  void showDisk(const recording::RecorderStats* recording);
  void setDisk(const recording::DiskSpace& space, double time_left);
  void separate();
  void set(Part part, const QString& text, Tone tone = Tone::kPlain);

  Theme theme_ = Theme::dark();
  std::array<QLabel*, kParts> labels_{};
  std::array<QLabel*, kParts> dots_{};  ///< before each part but the first that is seen
  std::array<Tone, kParts> tones_{};
  QToolButton* remedies_;
  QString folder_;
  bool tips_ = false;  ///< the camera samples are tips, not pictures
  QElapsedTimer disk_backlog_;
};

/// "lost", "frozen" or "failed", as of an encoder.
QString faultWords(tracking::MotorFault fault);

/// Minutes and seconds as 03:12, or 1:03:12 from an hour on.
QString clockText(double seconds);

}  // namespace capstan::widgets
