#include "core/learning/poses/states.h"

#include <algorithm>
#include <cmath>

#include "core/learning/poses/rotation_vector.h"
#include "core/learning/poses/stencil.h"

namespace capstan::learning {
namespace {

std::vector<double> stampsOf(const std::vector<StampedPose>& stream) {
  std::vector<double> t;
  for (const StampedPose& pose : stream) t.push_back(pose.t);
  return t;
}

Eigen::Matrix3Xd positionsOf(const std::vector<StampedPose>& stream) {
  Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(stream.size()));
  for (std::size_t k = 0; k < stream.size(); ++k)
    positions.col(static_cast<Eigen::Index>(k)) = stream[k].pose.translation();
  return positions;
}

std::vector<Eigen::Quaterniond> turnsOf(const std::vector<StampedPose>& stream) {
  std::vector<Eigen::Quaterniond> turns;
  for (const StampedPose& pose : stream) turns.emplace_back(pose.pose.linear());
  return turns;
}

constexpr double kSpeedSpan = 0.1;   // [s]
constexpr double kFastestTip = 0.5;  // [m/s]; a faster observation is a jump

/// Speeds of a stream over time. They are means over kSpeedSpan, because over shorter times the noise of
/// observations causes larger errors of speed.
struct Speeds {
  std::vector<double> t, speed;

  explicit Speeds(const std::vector<StampedPose>& stream) {
    for (std::size_t k = 0, from = 0; k < stream.size(); ++k) {
      while (stream[from].t < stream[k].t - kSpeedSpan) ++from;
      const double span = stream[k].t - stream[from].t;
      if (!(span > 0.5 * kSpeedSpan)) continue;
      const double way = (stream[k].pose.translation() - stream[from].pose.translation()).norm();
      if (way > kFastestTip * span) continue;
      t.push_back(0.5 * (stream[k].t + stream[from].t));
      speed.push_back(way / span);
    }
  }
  std::optional<double> at(double when) const {
    const auto after = std::lower_bound(t.begin(), t.end(), when);
    if (after == t.begin() || after == t.end()) return std::nullopt;
    const auto k = static_cast<std::size_t>(after - t.begin());
    if (t[k] - t[k - 1] > kLongestGap) return std::nullopt;
    const double share = (when - t[k - 1]) / (t[k] - t[k - 1]);
    return (1.0 - share) * speed[k - 1] + share * speed[k];
  }
};

/// Sum and number of a motion's differences of speed at each clock offset.
struct Misfit {
  Eigen::VectorXd sum, count;
};

/// Misfit over the observations that have a counterpart at every clock offset, so that all offsets are
/// compared on the same data. If a motion is too short for that, all observations are used.
Misfit misfitOf(const PoseMotion& motion, StreamKind reference, const std::vector<double>& clock_offsets) {
  constexpr double kEnough = 0.25;
  const Speeds observed(motion.of(StreamKind::kCamera)), commanded(motion.of(reference));
  const auto n = static_cast<Eigen::Index>(clock_offsets.size());
  Misfit all{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)}, whole = all;
  for (std::size_t k = 0; k < observed.t.size(); ++k) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(n), there = Eigen::VectorXd::Zero(n);
    for (Eigen::Index l = 0; l < n; ++l)
      if (const auto speed = commanded.at(observed.t[k] - clock_offsets[static_cast<std::size_t>(l)])) {
        difference[l] = std::min(std::abs(observed.speed[k] - *speed), kJump);
        there[l] = 1.0;
      }
    all.sum += difference, all.count += there;
    if (there.minCoeff() > 0.0) whole.sum += difference, whole.count += there;
  }
  return whole.count.sum() >= kEnough * static_cast<double>(n) * static_cast<double>(observed.t.size())
             ? whole
             : all;
}

std::vector<Misfit> misfitsOf(const std::vector<PoseMotion>& motions, StreamKind reference,
                              const std::vector<double>& clock_offsets) {
  std::vector<Misfit> misfits;
  for (const PoseMotion& motion : motions) misfits.push_back(misfitOf(motion, reference, clock_offsets));
  return misfits;
}

/// Mean difference of speeds over all motions.
Eigen::VectorXd meanOf(const std::vector<Misfit>& misfits) {
  if (misfits.empty()) return Eigen::VectorXd::Zero(1);
  Misfit all{Eigen::VectorXd::Zero(misfits.front().sum.size()),
             Eigen::VectorXd::Zero(misfits.front().sum.size())};
  for (const Misfit& one : misfits) all.sum += one.sum, all.count += one.count;
  return all.sum.cwiseQuotient(all.count.cwiseMax(1.0));
}

/// Clock offset at the minimum of the parabola through the smallest value and its neighbours.
double leastAt(const std::vector<double>& clock_offsets, const Eigen::VectorXd& mean) {
  Eigen::Index least = 0;
  mean.minCoeff(&least);
  const double at = clock_offsets[static_cast<std::size_t>(least)];
  if (least == 0 || least + 1 == mean.size()) return at;
  const double before = mean[least - 1], after = mean[least + 1];
  const double bend = before - 2.0 * mean[least] + after;
  return bend > 0.0 ? at + 0.5 * (before - after) / bend * (clock_offsets[1] - clock_offsets[0]) : at;
}

/// Mean velocity over the last `span` seconds before observation k.
Vector6d driftAt(const std::vector<StampedPose>& observed, std::size_t k, double span) {
  const double begin = observed[k].t - span;
  const auto from =
      std::lower_bound(observed.begin(), observed.begin() + static_cast<std::ptrdiff_t>(k), begin,
                       [](const StampedPose& pose, double when) { return pose.t < when; });
  const Eigen::Quaterniond here(observed[k].pose.linear()), there(from->pose.linear());
  Vector6d drift;
  drift << observed[k].pose.translation() - from->pose.translation(),
      rotationVector(there.conjugate() * here);
  return drift / span;
}

}  // namespace

std::vector<std::size_t> motionPlaces(const std::vector<State>& states) {
  std::vector<std::size_t> places(states.size(), 0);
  for (std::size_t k = 1; k < states.size(); ++k)
    places[k] = places[k - 1] + (states[k].motion != states[k - 1].motion);
  return places;
}

std::vector<PosePair> pairsOf(const std::vector<State>& states) {
  std::vector<PosePair> pairs;
  pairs.reserve(states.size());
  for (const State& state : states) pairs.push_back(state.pair);
  return pairs;
}

std::optional<Eigen::Isometry3d> poseAt(const std::vector<StampedPose>& stream, double t) {
  const auto after = std::lower_bound(stream.begin(), stream.end(), t,
                                      [](const StampedPose& pose, double when) { return pose.t < when; });
  if (after == stream.end()) return std::nullopt;
  if (after->t == t) return after->pose;
  if (after == stream.begin()) return std::nullopt;
  const StampedPose &a = *(after - 1), &b = *after;
  if (b.t - a.t > kLongestGap) return std::nullopt;
  const double share = (t - a.t) / (b.t - a.t);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(a.pose.linear())
                      .slerp(share, Eigen::Quaterniond(b.pose.linear()))
                      .toRotationMatrix();
  pose.translation() = (1.0 - share) * a.pose.translation() + share * b.pose.translation();
  return pose;
}

std::vector<State> statesAlong(const std::vector<StampedPose>& path) {
  const std::vector<double> t = stampsOf(path);
  const Eigen::Matrix3Xd v = velocitiesOf(t, positionsOf(path));
  const Eigen::Matrix3Xd w = angularVelocitiesOf(t, turnsOf(path));
  std::vector<State> states(path.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    states[k].row = path[k].row;
    states[k].t = path[k].t;
    states[k].pair.observed = path[k].pose;
    states[k].velocity << v.col(at), w.col(at);
    for (std::size_t i = 0; i < kSpans.size(); ++i) states[k].drift[i] = driftAt(path, k, kSpans[i]);
  }
  return states;
}

std::vector<State> statesOf(const std::vector<PoseMotion>& motions, StreamKind reference,
                            double clock_offset) {
  std::vector<State> states;
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (State& state : statesAlong(motions[m].of(StreamKind::kCamera))) {
      const auto pose = poseAt(motions[m].of(reference), state.t - clock_offset);
      if (!pose) continue;
      state.motion = m;
      state.pair.commanded = *pose;
      states.push_back(std::move(state));
    }
  return states;
}

ClockOffsetReport clockOffsetBetween(const std::vector<PoseMotion>& motions, StreamKind reference) {
  constexpr double kEarliest = -0.1, kLatest = 0.4;  // searched range [s]; delays are positive
  constexpr double kStep = 0.01;                     // of the grid search [s]
  ClockOffsetReport report;
  for (double clock_offset = kEarliest; clock_offset <= kLatest + 0.5 * kStep; clock_offset += kStep)
    report.tried.push_back(clock_offset);
  const Eigen::VectorXd coarse = meanOf(misfitsOf(motions, reference, report.tried));
  report.misfit.assign(coarse.data(), coarse.data() + coarse.size());
  Eigen::Index least = 0;
  coarse.minCoeff(&least);
  std::vector<double> near;  // near the minimum almost every observation has a counterpart
  for (const int step : {-2, -1, 0, 1, 2})
    near.push_back(report.tried[static_cast<std::size_t>(least)] + step * kStep);
  const std::vector<Misfit> misfits = misfitsOf(motions, reference, near);
  report.clock_offset = leastAt(near, meanOf(misfits));
  double squares = 0.0, used = 0.0;
  for (std::size_t m = 0; m < misfits.size(); ++m) {
    if (misfits[m].count.maxCoeff() < 1.0) continue;
    std::vector<Misfit> others = misfits;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(m));
    squares += std::pow(leastAt(near, meanOf(others)) - report.clock_offset, 2);
    used += 1.0;
  }
  if (used > 1.0) report.sigma = std::sqrt(squares * (used - 1.0) / used);
  return report;
}

}  // namespace capstan::learning
