#pragma once

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace capstan::widgets {

/// Builds the points of one line from the history's blocks: one point where low == high, else two, ordered
/// along the direction of the curve, so that a slope stays a slope.
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

/// Cuts a line into dashes: `on` out of every `period` seconds is drawn. Dashes are anchored to time, so that
/// they do not move along a scrolling curve (those of a QPen do, and take ten times as long to draw). A gap
/// hides no spike: a point that exceeds its neighbours and the dash before it by more than `prominence` is
/// drawn with the lines to its neighbours.
class DashCutter {
 public:
  DashCutter(double period, double on, double prominence)
      : period_(period), on_(on), prominence_(prominence) {}

  void cut(const QVector<QCPGraphData>& line, QVector<QCPGraphData>& dashed) {
    dashed.resize(0);
    dash_ = QCPRange();
    bool out = false;
    for (int i = 0; i + 1 < line.size(); ++i) {
      const QCPGraphData &from = line[i], &to = line[i + 1];
      const bool next_out = standsOut(line, i + 1);
      if (to.key <= from.key || std::isnan(from.value) || std::isnan(to.value))
        dashed.append({from.key, kNone});
      else if (out || next_out)
        dashed << from << to << QCPGraphData(to.key, kNone);
      else
        cutLine(from, to, dashed);
      out = next_out;
    }
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  bool standsOut(const QVector<QCPGraphData>& line, int i) const {
    if (i < 1 || i + 1 >= line.size()) return false;
    const double value = line[i].value, a = line[i - 1].value, b = line[i + 1].value;
    return value > std::max({a, b, dash_.upper}) + prominence_ ||
           value < std::min({a, b, dash_.lower}) - prominence_;
  }

  void cutLine(const QCPGraphData& from, const QCPGraphData& to, QVector<QCPGraphData>& dashed) {
    const double length = to.key - from.key;
    const auto at = [&](double t) { return from.value + (to.value - from.value) * (t - from.key) / length; };
    const auto first = static_cast<std::int64_t>(std::floor(from.key / period_));
    for (std::int64_t k = first; static_cast<double>(k) * period_ < to.key; ++k) {
      const double dash = static_cast<double>(k) * period_;
      const double begin = std::max(dash, from.key), end = std::min(dash + on_, to.key);
      if (begin > end) continue;
      dash_ = begin == dash ? QCPRange(at(begin), at(begin)) : dash_;
      dash_.expand(at(begin));
      dash_.expand(at(end));
      dashed.append({begin, at(begin)});
      if (end > begin) dashed.append({end, at(end)});
      if (end == dash + on_) dashed.append({end, kNone});
    }
  }

  double period_, on_, prominence_;
  QCPRange dash_;  ///< range of values of the last dash
};

}  // namespace capstan::widgets
