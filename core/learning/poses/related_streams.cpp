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

/// How wide nine tenths of a stream's positions lie along each of its axes [m].
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

/// What makes two streams differ so: an axis far wider than all of the other's is in another unit.
std::string unitsAdvice(const std::vector<State>& states, StreamKind towards) {
  constexpr double kOtherUnit = 4.0;  // a frame that is turned makes it √3
  const Eigen::Vector3d seen = widthsOf(states, &PosePair::seen), told = widthsOf(states, &PosePair::told);
  const bool is_seen = seen.maxCoeff() > told.maxCoeff();
  const Eigen::Vector3d& wide = is_seen ? seen : told;
  const double narrow = (is_seen ? told : seen).maxCoeff();
  std::string axes;
  for (Eigen::Index i = 0; i < 3; ++i)
    if (wide[i] > kOtherUnit * narrow) axes += fmt::format("{}{}", axes.empty() ? "" : ", ", "xyz"[i]);
  if (axes.empty()) return "Check units (metres), the order of axes and of quaternions (x, y, z, w)";
  const StreamKind wider = is_seen ? StreamKind::kCamera : towards,
                   other = is_seen ? towards : StreamKind::kCamera;
  return fmt::format("Give {} of the {} in metres: it is up to {:.3g} m wide, all of the {} {:.2g} m", axes,
                     base::nameOf(wider), wide.maxCoeff(), base::nameOf(other), narrow);
}

/// Median distance of what was told from its middle [m].
double sizeOf(const std::vector<State>& states) {
  std::array<std::vector<double>, 3> told;
  for (const State& state : states)
    for (std::size_t i = 0; i < 3; ++i)
      told[i].push_back(state.pair.told.translation()[static_cast<Eigen::Index>(i)]);
  const Eigen::Vector3d middle(stats::median(told[0]), stats::median(told[1]), stats::median(told[2]));
  std::vector<double> way;
  for (const State& state : states) way.push_back((state.pair.told.translation() - middle).norm());
  return stats::median(std::move(way));
}

/// Medians of what the offset leaves.
struct Left {
  double distance = 0.0;  ///< [m]
  double turn = 0.0;      ///< [rad]
};
Left leftOf(const std::vector<State>& states, const Eigen::Isometry3d& offset) {
  std::vector<double> distance, turn;
  for (const State& state : states) {
    const Eigen::Isometry3d off = state.pair.told.inverse() * offset * state.pair.seen;
    distance.push_back(off.translation().norm());
    turn.push_back(Eigen::AngleAxisd(off.linear()).angle());
  }
  return {stats::median(std::move(distance)), stats::median(std::move(turn))};
}

void checkDistance(const std::vector<State>& states, double left, double size, StreamKind towards) {
  constexpr double kMost = 0.6;
  if (left <= kMost * size) return;
  throw base::InputError(
      {{},
       0,
       "poses",
       fmt::format("{:.3g} m", left),
       fmt::format("is what the best rigid offset leaves of half of the sights, and motions are "
                   "{:.3g} m long",
                   size),
       unitsAdvice(states, towards) + "; both streams must be of one arm, and it must move"});
}

/// A mount that turns the marker turns all sights alike.
void checkTurn(double left, double of_all) {
  constexpr double kMost = 1.0;  // [rad]
  if (left <= of_all + kMost) return;
  throw base::InputError(
      {{},
       0,
       "quaternions",
       fmt::format("{:.0f} deg", left * 180.0 / std::numbers::pi),
       fmt::format("is the turn that the best rigid offset leaves of half of the sights, of "
                   "all tables' {:.0f} deg",
                   of_all * 180.0 / std::numbers::pi),
       "Give quaternions in the order x, y, z, w, of the same marker in all tables"});
}

}  // namespace

void checkRelated(const std::vector<PoseMotion>& motions, const std::vector<State>& states,
                  const Eigen::Isometry3d& offset, StreamKind towards) {
  std::map<std::string, std::vector<State>> tables;
  for (const State& state : states) tables[motions[state.motion].table].push_back(state);
  const double size = sizeOf(states), turn = leftOf(states, offset).turn;
  for (const auto& [table, some] : tables)
    base::namingFile(table, [&] {
      const Left left = leftOf(some, offset);
      checkDistance(some, left.distance, size, towards);
      checkTurn(left.turn, turn);
    });
}

}  // namespace capstan::learning
