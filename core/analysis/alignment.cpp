#include "core/analysis/alignment.h"

#include <algorithm>
#include <cmath>

namespace capstan::analysis {
namespace {

using Eigen::Vector3d;
using Speeds = std::vector<Vector3d>;

constexpr int kCoarse = 5;         // steps of a series in one step of the first search
constexpr double kShortest = 2.0;  // [s]
constexpr double kLeastShare = 1.0 / 3.0;

/// Speeds over `every` steps of the series, in units of `scale`.
Speeds speedsOf(const MotionSeries& series, int every, const Vector3d& scale) {
  const auto& q = series.positions();
  const auto step = static_cast<std::size_t>(every);
  Speeds speeds;
  for (std::size_t i = step; i < q.size(); i += step)
    speeds.push_back((q[i] - q[i - step]).cwiseProduct(scale) / (MotionSeries::kStep * every));
  return speeds;
}

Vector3d rmsOf(const Speeds& speeds) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& speed : speeds) sum += speed.cwiseAbs2();
  return (sum / static_cast<double>(std::max<std::size_t>(speeds.size(), 1))).cwiseSqrt();
}

/// Correlation of the overlap when b is moved by `lag` steps: b[i + lag] beside a[i].
double correlation(const Speeds& a, const Speeds& b, long lag) {
  const long begin = std::max(0L, -lag);
  const long end = std::min(static_cast<long>(a.size()), static_cast<long>(b.size()) - lag);
  double product = 0.0, of_a = 0.0, of_b = 0.0;
  for (long i = begin; i < end; ++i) {
    const Vector3d &x = a[static_cast<std::size_t>(i)], &y = b[static_cast<std::size_t>(i + lag)];
    product += x.dot(y);
    of_a += x.squaredNorm();
    of_b += y.squaredNorm();
  }
  return of_a > 0.0 && of_b > 0.0 ? product / std::sqrt(of_a * of_b) : -1.0;
}

/// Place of the largest value about x[1] of a parabola through three equidistant values, in steps from it.
double top(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

}  // namespace

void MotionSeries::add(double t, const Vector3d& q) {
  if (!q.allFinite() || !std::isfinite(t)) return;
  if (positions_.empty()) {
    begin_ = last_t_ = t;
    last_ = q;
    positions_.push_back(q);
    return;
  }
  for (double next = end(); next <= t && t > last_t_; next = end()) {
    const double share = t - last_t_ > kGap ? 0.0 : (next - last_t_) / (t - last_t_);
    positions_.push_back(last_ + share * (q - last_));
  }
  last_t_ = std::max(last_t_, t);
  last_ = q;
}

std::optional<Alignment> alignmentOf(const MotionSeries& a, const MotionSeries& b) {
  const double shorter = std::min(a.end() - a.begin(), b.end() - b.begin());
  if (shorter < kShortest) return std::nullopt;
  const Vector3d ones = Vector3d::Ones();
  const Vector3d rms = rmsOf(speedsOf(a, kCoarse, ones)) + rmsOf(speedsOf(b, kCoarse, ones));
  if (rms.maxCoeff() <= 0.0) return std::nullopt;
  Vector3d scale = Vector3d::Zero();
  for (int joint = 0; joint < 3; ++joint)
    if (rms(joint) > 1e-6 * rms.maxCoeff()) scale(joint) = 1.0 / rms(joint);

  const Speeds coarse_a = speedsOf(a, kCoarse, scale), coarse_b = speedsOf(b, kCoarse, scale);
  const auto least =
      static_cast<long>(kLeastShare * static_cast<double>(std::min(coarse_a.size(), coarse_b.size())));
  const long lowest = least - static_cast<long>(coarse_a.size());
  const long highest = static_cast<long>(coarse_b.size()) - least;
  std::vector<double> tried;
  for (long lag = lowest; lag <= highest; ++lag) tried.push_back(correlation(coarse_a, coarse_b, lag));
  const long best = lowest + (std::max_element(tried.begin(), tried.end()) - tried.begin());

  const Speeds fine_a = speedsOf(a, 1, scale), fine_b = speedsOf(b, 1, scale);
  long at = kCoarse * best;
  double most = -1.0;
  for (long lag = kCoarse * (best - 1); lag <= kCoarse * (best + 1); ++lag)
    if (const double found = correlation(fine_a, fine_b, lag); found > most) most = found, at = lag;
  const double between = top(correlation(fine_a, fine_b, at - 1), most, correlation(fine_a, fine_b, at + 1));

  Alignment alignment;
  const double shift = (static_cast<double>(at) + between) * MotionSeries::kStep;
  alignment.offset = b.begin() - a.begin() + shift;
  alignment.correlation = most;
  alignment.second_best = -1.0;
  const long apart = std::lround(Alignment::kApart / (kCoarse * MotionSeries::kStep));
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (std::abs(lowest + static_cast<long>(i) - best) > apart)
      alignment.second_best = std::max(alignment.second_best, tried[i]);
  alignment.overlap =
      std::min(a.end(), b.end() - alignment.offset) - std::max(a.begin(), b.begin() - alignment.offset);
  return alignment;
}

}  // namespace capstan::analysis
