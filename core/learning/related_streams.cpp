#include "core/learning/related_streams.h"

#include <fmt/format.h>

#include <array>

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

}  // namespace

void checkRelated(const std::vector<State>& states, const Eigen::Isometry3d& offset, StreamKind towards) {
  constexpr double kMost = 0.6;
  std::vector<double> off, way;
  std::array<std::vector<double>, 3> told;
  for (const State& state : states)
    for (std::size_t i = 0; i < 3; ++i)
      told[i].push_back(state.pair.told.translation()[static_cast<Eigen::Index>(i)]);
  const Eigen::Vector3d middle(stats::median(told[0]), stats::median(told[1]), stats::median(told[2]));
  for (const State& state : states) {
    off.push_back((offset * state.pair.seen.translation() - state.pair.told.translation()).norm());
    way.push_back((state.pair.told.translation() - middle).norm());
  }
  const double left = stats::median(off), size = stats::median(way);
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

}  // namespace capstan::learning
