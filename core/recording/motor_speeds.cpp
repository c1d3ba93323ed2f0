#include "core/recording/motor_speeds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/stats/quantile.h"

namespace capstan::recording {
namespace {

constexpr std::size_t kWindow = 20;   ///< rows to either side; fewer let encoder counts disturb speeds
constexpr std::size_t kFewest = 100;  ///< smallest number of pairs of speeds
constexpr double kAlike = 0.7;

double ratioOf(const std::vector<double>& t, const std::vector<double>& q_m, const std::vector<double>& dq_m,
               double factor) {
  double shown = 0.0, both = 0.0, measured = 0.0;
  std::size_t pairs = 0;
  for (std::size_t row = kWindow; row + kWindow < t.size(); ++row) {
    const double speed =
        factor * (q_m[row + kWindow] - q_m[row - kWindow]) / (t[row + kWindow] - t[row - kWindow]);
    if (!std::isfinite(speed) || !std::isfinite(dq_m[row])) continue;
    shown += speed * speed;
    both += speed * dq_m[row];
    measured += dq_m[row] * dq_m[row];
    ++pairs;
  }
  if (pairs < kFewest || !(both > kAlike * std::sqrt(shown * measured)))
    return std::numeric_limits<double>::quiet_NaN();
  return both / shown;
}

}  // namespace

const double MotorSpeeds::kNone = std::numeric_limits<double>::quiet_NaN();

double medianPeriod(const MeasuredTable& table) {
  if (table.rows() < 2) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> periods(table.rows() - 1);
  for (std::size_t row = 0; row < periods.size(); ++row) periods[row] = table.t[row + 1] - table.t[row];
  return stats::median(periods);
}

MotorSpeeds::MotorSpeeds(const MeasuredTable& table, const MotorFactors& position, double time) {
  for (std::size_t i = 0; i < std::min(table.q_m.size(), table.dq_m.size()); ++i)
    ratios_.push_back(ratioOf(table.t, table.q_m[i], table.dq_m[i], position[i] / time));
}

bool MotorSpeeds::any() const {
  return std::any_of(ratios_.begin(), ratios_.end(), [](double ratio) { return !std::isnan(ratio); });
}

bool MotorSpeeds::agree() const {
  return std::none_of(ratios_.begin(), ratios_.end(), [](double r) { return r < 1.0 / 3.0 || r > 3.0; });
}

}  // namespace capstan::recording
