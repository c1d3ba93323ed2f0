#include "widgets/figures/linked_figures.h"

namespace capstan::widgets {

LinkedFigures::LinkedFigures(JointFigure& first, JointFigure& second, double offset, QObject* parent)
    : QObject(parent) {
  follow(first, second, offset);
  follow(second, first, -offset);
  const QCPRange time = first.timeRange();
  second.setTimeRange(time.lower + offset, time.upper + offset);
}

void LinkedFigures::follow(JointFigure& from, JointFigure& to, double offset) {
  connect(&from, &JointFigure::timeRangeShown, this, [this, &to, offset](double begin, double end) {
    if (moving_) return;
    moving_ = true;
    to.setTimeRange(begin + offset, end + offset);
    moving_ = false;
  });
  connect(&from, &JointFigure::cursorMoved, this, [this, &to, offset](std::optional<double> t) {
    if (moving_) return;
    moving_ = true;
    to.setCursor(t ? std::optional(*t + offset) : std::nullopt);
    moving_ = false;
  });
}

}  // namespace capstan::widgets
