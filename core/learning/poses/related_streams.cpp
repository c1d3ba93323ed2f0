#include "core/learning/poses/related_streams.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <numbers>
#include <string>

#include "core/base/error.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

/// Range of 90 % of a stream's positions along each axis [m].
Eigen::Vector3d widthsOf(const std::vector<State>& states, Eigen::Isometry3d PosePair::*pose) {
  constexpr std::array kTails = {0.05, 0.95};
  Eigen::Vector3d widths;
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::vector<double> along;
    for (const State& state : states) along.push_back((state.pair.*pose).translation()[i]);
    const std::vector<double> ends = stats::quantiles(along, kTails);
    widths[i] = ends[1] - ends[0];
  }
  return widths;
}

/// Advice for streams that are not related: an axis with a far larger range than all axes of the other stream
/// is in another unit.
std::string unitsAdvice(const std::vector<State>& states, StreamKind towards) {
  constexpr double kOtherUnit = 4.0;  // a rotated frame changes it by at most √3
  const Eigen::Vector3d observed = widthsOf(states, &PosePair::observed),
                        commanded = widthsOf(states, &PosePair::commanded);
  const bool is_seen = observed.maxCoeff() > commanded.maxCoeff();
  const Eigen::Vector3d& wide = is_seen ? observed : commanded;
  const double narrow = (is_seen ? commanded : observed).maxCoeff();
  std::string axes;
  for (Eigen::Index i = 0; i < 3; ++i)
    if (wide[i] > kOtherUnit * narrow) axes += fmt::format("{}{}", axes.empty() ? "" : ", ", "xyz"[i]);
  if (axes.empty()) return "Check units (metres), the order of axes and of quaternions (x, y, z, w)";
  const StreamKind wider = is_seen ? StreamKind::kCamera : towards,
                   other = is_seen ? towards : StreamKind::kCamera;
  return fmt::format("Give {} of the {} in metres: its range is up to {:.3g} m, that of the {} only {:.2g} m",
                     axes, base::nameOf(wider), wide.maxCoeff(), base::nameOf(other), narrow);
}

/// Median distance of commanded positions from their mean [m].
double sizeOf(const std::vector<State>& states) {
  std::array<std::vector<double>, 3> commanded;
  for (const State& state : states)
    for (std::size_t i = 0; i < 3; ++i)
      commanded[i].push_back(state.pair.commanded.translation()[static_cast<Eigen::Index>(i)]);
  const Eigen::Vector3d middle(stats::median(commanded[0]), stats::median(commanded[1]),
                               stats::median(commanded[2]));
  std::vector<double> way;
  for (const State& state : states) way.push_back((state.pair.commanded.translation() - middle).norm());
  return stats::median(std::move(way));
}

/// Median residuals of the offset.
struct Left {
  double distance = 0.0;  ///< [m]
  double rotation = 0.0;  ///< [rad]
};
Left leftOf(const std::vector<State>& states, const Eigen::Isometry3d& offset) {
  std::vector<double> distance, rotation;
  for (const State& state : states) {
    const Eigen::Isometry3d off = state.pair.commanded.inverse() * offset * state.pair.observed;
    distance.push_back(off.translation().norm());
    rotation.push_back(Eigen::AngleAxisd(off.linear()).angle());
  }
  return {stats::median(std::move(distance)), stats::median(std::move(rotation))};
}

void checkDistance(const std::vector<State>& states, double left, double size, StreamKind towards) {
  constexpr double kMost = 0.6;
  if (left <= kMost * size) return;
  throw base::InputError(
      {{},
       0,
       "poses",
       fmt::format("{:.3g} m", left),
       fmt::format("is the median residual of the best rigid offset, and motions are only "
                   "{:.3g} m long",
                   size),
       unitsAdvice(states, towards) + "; both streams must be of one arm, and it must move"});
}

/// Checks the rotation. A rotated marker mount is no error, because it rotates all observations in the same
/// way.
void checkRotation(double left, double of_all) {
  constexpr double kMost = 1.0;  // [rad]
  if (left <= of_all + kMost) return;
  throw base::InputError({{},
                          0,
                          "quaternions",
                          fmt::format("{:.0f} deg", left * 180.0 / std::numbers::pi),
                          fmt::format("is the median rotation residual of the best rigid offset; over "
                                      "all tables it is {:.0f} deg",
                                      of_all * 180.0 / std::numbers::pi),
                          "Give quaternions in the order x, y, z, w, of the same marker in all tables"});
}

}  // namespace

void checkRelated(const std::vector<PoseMotion>& motions, const std::vector<State>& states,
                  const Eigen::Isometry3d& offset, StreamKind towards) {
  std::map<std::string, std::vector<State>> tables;
  for (const State& state : states) tables[motions[state.motion].table].push_back(state);
  const double size = sizeOf(states), rotation = leftOf(states, offset).rotation;
  for (const auto& entry : tables)
    base::namingFile(entry.first, [&] {
      const std::vector<State>& some = entry.second;
      const Left left = leftOf(some, offset);
      checkDistance(some, left.distance, size, towards);
      checkRotation(left.rotation, rotation);
    });
}

}  // namespace capstan::learning
