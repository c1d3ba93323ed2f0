#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <optional>

#include "widgets/panels/replay/time_line.h"

class QLabel;
class QToolButton;

namespace capstan::widgets {

/// Time line of the session with the controls of the review: a time that was tracked already is shown again,
/// while the session itself stays where it is. In review the bar emits the time in view; else it follows the
/// newest one.
class ReplayBar : public QWidget {
  Q_OBJECT

 public:
  explicit ReplayBar(const JointHistory& history, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Begins another session of `duration` [s] from `begin` [s]; 0: not known.
  void begin(double begin, double duration);
  void addEvent(double t, const QString& kind, const QString& text) { line_->addEvent({t, kind, text}); }
  /// The newest time of the session [s].
  void setNewest(double t);
  /// Speed of the playback in review, as a multiple of real time.
  void setSpeed(double speed) { speed_ = speed; }

  bool reviewing() const { return time_.has_value(); }
  bool playing() const { return timer_.isActive(); }
  /// Time in view [s]; none: the newest.
  std::optional<double> time() const { return time_; }
  TimeLine& line() { return *line_; }
  const TimeLoop& loop() const { return loop_; }

  /// Shows the time t [s], within what was tracked.
  void review(double t);
  void setLoop(const TimeLoop& loop);
  void togglePlaying();
  /// Ends the review: the newest time is in view again.
  void follow();
  /// Moves to the next event (+1) or the one before (−1).
  void stepEvent(int by);
  /// Moves by pairs of images, of kFrame.
  void stepFrame(int by);

 signals:
  void reviewed(double t);
  void followed();

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  static constexpr double kFrame = 1.0 / 15.0;  ///< [s]
  QToolButton* addButton(const QString& text, const QString& tip, void (ReplayBar::*act)());
  void setFrom();
  void setTo();
  void clearLoop();
  void advance();
  void refresh();
  double newest() const;

  const JointHistory& history_;
  TimeLine* line_;
  QLabel* clock_;
  QToolButton *play_, *from_, *to_, *clear_, *follow_;
  QTimer timer_;
  QElapsedTimer since_;
  double speed_ = 1.0, newest_ = 0.0;
  std::optional<double> time_;
  TimeLoop loop_;
};

}  // namespace capstan::widgets
