#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// An event of the session on the time line.
struct TimeLineEvent {
  double t = 0.0;  ///< [s]
  QString kind, text;
};

/// Loop between two times [s].
struct TimeLoop {
  std::optional<double> from, to;
  bool closed() const { return from && to && *to > *from; }
};

/// The whole session as a line: the part that was tracked, occlusions, events as ticks, the loop, and the
/// time in view. Click or drag to move; Shift and drag to choose a loop.
class TimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit TimeLine(const JointHistory& history, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Sets the ends of the line [s]; it also reaches as far as the history.
  void setRange(double begin, double end);
  void setTime(double t);
  void setLoop(const TimeLoop& loop);
  void clearEvents();
  void addEvent(const TimeLineEvent& event);

  double begin() const { return begin_; }
  double end() const;
  /// The event after t, or before it; none where there is no other.
  std::optional<double> eventAfter(double t) const;
  std::optional<double> eventBefore(double t) const;
  /// Horizontal place of a time, for tests.
  int placeOf(double t) const;

  QSize sizeHint() const override { return {400, 44}; }
  QSize minimumSizeHint() const override { return {160, 44}; }

 signals:
  void timeChosen(double t);
  void loopChosen(const capstan::widgets::TimeLoop& loop);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  QRect band() const;
  double timeAt(double x) const;
  QColor colourOf(const QString& kind) const;
  void drawTicks(QPainter& painter);
  void drawAxis(QPainter& painter);

  const JointHistory& history_;
  Theme theme_ = Theme::dark();
  double begin_ = 0.0, end_ = 0.0, time_ = 0.0;
  TimeLoop loop_;
  std::optional<double> loop_from_;  ///< while it is dragged
  std::vector<TimeLineEvent> events_;
};

}  // namespace capstan::widgets
