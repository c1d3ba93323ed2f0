#include "widgets/figures/time_shade.h"

#include <algorithm>

namespace capstan::widgets {

std::vector<TimeInterval> gapsIn(const std::vector<double>& t, double longest) {
  std::vector<TimeInterval> gaps;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i] - t[i - 1] > longest) gaps.emplace_back(t[i - 1], t[i]);
  return gaps;
}

double typicalPeriod(const std::vector<double>& t) {
  if (t.size() < 2) return 0.0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

TimeShade::TimeShade(QCPAxisRect* axes, std::vector<TimeInterval> intervals)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("background"), axes),
      axes_(axes),
      intervals_(std::move(intervals)) {}

/// SVG files have no clipping: shades are cut to the axis here.
void TimeShade::draw(QCPPainter* painter) {
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const QRect area = axes_->rect();
  for (const TimeInterval& interval : intervals_) {
    const double left = std::max<double>(time->coordToPixel(interval.lower), area.left());
    const double right = std::min<double>(time->coordToPixel(interval.upper), area.right() + 1);
    if (right < left) continue;
    painter->fillRect(QRectF(left, area.top(), std::max(right - left, 1.0), area.height()), colour_);
  }
}

}  // namespace capstan::widgets
