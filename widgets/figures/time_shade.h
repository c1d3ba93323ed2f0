#pragma once

#include <qcustomplot.h>

#include <vector>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// A time in which the camera did not see the robot, or a sensor gave nothing [s].
using TimeInterval = QCPRange;

/// Intervals without a sample: where the rising times `t` are further apart than `longest` [s].
std::vector<TimeInterval> gapsIn(const std::vector<double>& t, double longest);

/// Typical period of the rising times `t`: the median of their differences; 0 for fewer than two.
double typicalPeriod(const std::vector<double>& t);

/// Shades time intervals behind the curves of one axis rect.
class TimeShade : public QCPLayerable {
  Q_OBJECT
 public:
  TimeShade(QCPAxisRect* axes, std::vector<TimeInterval> intervals);

  void setColour(const QColor& colour) { colour_ = colour; }
  const std::vector<TimeInterval>& intervals() const { return intervals_; }

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
  void draw(QCPPainter* painter) override;

 private:
  QCPAxisRect* axes_;
  std::vector<TimeInterval> intervals_;
  QColor colour_;
};

}  // namespace capstan::widgets
