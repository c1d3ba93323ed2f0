#pragma once

#include <qcustomplot.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace capstan::widgets {

/// Builds the points of one line from the history's buckets: one point where low == high, else two, in the
/// order that follows the curve's own direction, so that a slope stays a slope.
class CurveBuilder {
 public:
  void begin() {
    points_.resize(0);
    last_ = std::numeric_limits<double>::quiet_NaN();
  }
  void add(double t, double step, float low, float high) {
    const double a = static_cast<double>(low), b = static_cast<double>(high);
    if (low == high || std::isnan(a)) {
      points_.append({t, a});
    } else {
      // The first bucket's direction shows with the second.
      if (points_.size() == 2 && points_[0].value < points_[1].value && a + b < 2.0 * last_)
        std::swap(points_[0].value, points_[1].value);
      const bool rising = std::isnan(last_) || a + b >= 2.0 * last_;
      points_.append({t, rising ? a : b});
      points_.append({t + 0.95 * step, rising ? b : a});
    }
    last_ = 0.5 * (a + b);
  }
  const QVector<QCPGraphData>& points() const { return points_; }

 private:
  QVector<QCPGraphData> points_;
  double last_ = 0.0;
};

/// Cuts gaps into a line: `on` out of every `period` seconds is drawn, anchored to time, so that dashes stay
/// where they are on a scrolling curve (a dashed QPen crawls, and costs ten times the drawing).
inline void cutDashes(const QVector<QCPGraphData>& line, double period, double on,
                      QVector<QCPGraphData>& dashed) {
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  dashed.resize(0);
  for (int i = 0; i + 1 < line.size(); ++i) {
    const QCPGraphData &from = line[i], &to = line[i + 1];
    const double length = to.key - from.key;
    if (length <= 0.0 || std::isnan(from.value) || std::isnan(to.value)) {
      dashed.append({from.key, kGap});
      continue;
    }
    const auto at = [&](double t) { return from.value + (to.value - from.value) * (t - from.key) / length; };
    const auto first = static_cast<std::int64_t>(std::floor(from.key / period));
    for (std::int64_t k = first; static_cast<double>(k) * period < to.key; ++k) {
      const double dash = static_cast<double>(k) * period;
      const double begin = std::max(dash, from.key), end = std::min(dash + on, to.key);
      if (begin > end) continue;
      dashed.append({begin, at(begin)});
      if (end > begin) dashed.append({end, at(end)});
      if (end == dash + on) dashed.append({end, kGap});
    }
  }
}

}  // namespace capstan::widgets
