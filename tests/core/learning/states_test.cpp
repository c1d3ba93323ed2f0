// Screening, pairing and cleaning of motions that were made up, so that all is known.
#include "core/learning/poses/states.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/learning/poses/clean_states.h"
#include "core/learning/poses/rotation_vector.h"
#include "core/learning/poses/screen_poses.h"

namespace capstan::learning {
namespace {

const Eigen::Isometry3d kOffset = [] {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.linear() = turnBy({0.1, 0.2, -0.3}).toRotationMatrix();
  offset.translation() = Eigen::Vector3d(0.01, -0.02, 0.005);
  return offset;
}();
constexpr double kLag = 0.12;  // of the cameras behind what was told

/// Where motion m was told to be at t: along curves at some 5 cm/s.
Eigen::Isometry3d toldAt(std::size_t m, double t) {
  const double phase = 0.7 * static_cast<double>(m);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() =
      Eigen::Vector3d(0.03 * std::sin(1.7 * t + phase), 0.02 * std::cos(2.3 * t), 0.02 * std::sin(t));
  pose.linear() = turnBy({0.4 * std::sin(t), 0.3 * std::cos(0.8 * t + phase), 0.2 * t}).toRotationMatrix();
  return pose;
}

RawPose raw(std::size_t row, double t, const Eigen::Isometry3d& pose) {
  return {row, t, pose.translation(), Eigen::Quaterniond(pose.linear()).coeffs()};
}

/// Three seconds at 100 Hz each, stamps a little uneven.
std::vector<RawMotion> motions(std::size_t count) {
  base::Random random(2, "motions");
  std::vector<RawMotion> made;
  for (std::size_t m = 0; m < count; ++m) {
    RawMotion motion{"trajectory " + std::to_string(m), {}};
    for (std::size_t k = 0; k < 300; ++k) {
      const double t = 0.01 * static_cast<double>(k) + random.uniform(0.0, 0.004);
      const std::size_t row = 2 + 300 * m + k;
      motion.streams[0].push_back(raw(row, t, kOffset.inverse() * toldAt(m, t - kLag)));
      motion.streams[2].push_back(raw(row, t, toldAt(m, t)));
    }
    made.push_back(std::move(motion));
  }
  return made;
}

TEST(ScreenPoses, keepsPosesAndListsTheRest) {
  std::vector<RawMotion> some = motions(2);
  std::vector<RawPose>& observed = some[1].streams[0];
  observed[10].position.setZero(), observed[10].quaternion = Eigen::Vector4d::UnitW();
  observed[11].position.setZero(), observed[11].quaternion.setZero();
  observed[20].position.y() = std::numeric_limits<double>::quiet_NaN();
  observed[30].quaternion *= 1.5;
  observed[41] = observed[40];
  observed[50].t = observed[45].t;
  const ScreenReport report = screenPoses(some);
  EXPECT_EQ(report.rows[0], 600U);
  EXPECT_EQ(report.poses[0], 594U);
  EXPECT_EQ(report.poses[1], 0U);
  EXPECT_EQ(report.poses[2], 600U);
  EXPECT_EQ(report.count(StreamKind::kCamera, Reason::kPlaceholder), 2U);
  EXPECT_EQ(report.count(StreamKind::kCamera, Reason::kNotFinite), 1U);
  EXPECT_EQ(report.count(StreamKind::kCamera, Reason::kNoRotation), 1U);
  EXPECT_EQ(report.count(StreamKind::kCamera, Reason::kRepeat), 1U);
  EXPECT_EQ(report.count(StreamKind::kCamera, Reason::kBackInTime), 1U);
  ASSERT_EQ(report.rejected.size(), 6U);
  EXPECT_EQ(report.rejected.front().motion, 1U);
  EXPECT_EQ(report.rejected.front().row, 2U + 300U + 10U);
  for (const StampedPose& pose : report.motions[1].of(StreamKind::kCamera))
    EXPECT_TRUE(pose.pose.matrix().allFinite());
}

TEST(PoseAt, liesBetweenItsNeighboursAndNowhereElse) {
  const ScreenReport report = screenPoses(motions(1));
  const auto& commanded = report.motions[0].of(StreamKind::kCommand);
  const double t = 0.3 * commanded[100].t + 0.7 * commanded[101].t;
  const auto pose = poseAt(commanded, t);
  ASSERT_TRUE(pose.has_value());
  EXPECT_LT(squaredDistance(*pose, toldAt(0, t), kLever), 1e-10);
  EXPECT_TRUE(poseAt(commanded, commanded.front().t).has_value());
  EXPECT_TRUE(poseAt(commanded, commanded.back().t).has_value());
  EXPECT_FALSE(poseAt(commanded, commanded.front().t - 1e-3).has_value());
  EXPECT_FALSE(poseAt(commanded, commanded.back().t + 1e-3).has_value());
  std::vector<StampedPose> gap(commanded);
  gap.erase(gap.begin() + 90, gap.begin() + 110);
  EXPECT_FALSE(poseAt(gap, t).has_value()) << "within a gap";
  EXPECT_FALSE(poseAt({}, 0.0).has_value());
}

TEST(LagBetween, isFoundWhateverTheOffset) {
  const ScreenReport report = screenPoses(motions(6));
  const ClockOffsetReport clock_offset = clockOffsetBetween(report.motions, StreamKind::kCommand);
  EXPECT_NEAR(clock_offset.clock_offset, kLag, 0.003);
  EXPECT_LT(clock_offset.sigma, 0.003);
  EXPECT_EQ(clock_offset.tried.size(), clock_offset.misfit.size());
}

TEST(LagBetween, isNotMovedByTheNoiseOfObservations) {
  std::vector<RawMotion> noisy = motions(6);
  base::Random random(7, "noise of sights");
  for (RawMotion& motion : noisy)
    for (RawPose& pose : motion.streams[0])
      for (double& x : pose.position) x += random.normal(0.0, 2e-4);
  EXPECT_NEAR(clockOffsetBetween(screenPoses(noisy).motions, StreamKind::kCommand).clock_offset, kLag, 0.01);
}

TEST(StatesOf, pairWhatBelongsTogether) {
  const ScreenReport report = screenPoses(motions(2));
  const std::vector<State> states = statesOf(report.motions, StreamKind::kCommand, kLag);
  ASSERT_GT(states.size(), 550U) << "the first tenth of a second has no command";
  for (const State& state : states) {
    EXPECT_LT(squaredDistance(kOffset * state.pair.observed, state.pair.commanded, kLever), 1e-9);
    constexpr double kStep = 1e-5;
    const auto at = [&](double t) {
      return Eigen::Isometry3d(kOffset.inverse() * toldAt(state.motion, t - kLag));
    };
    const Eigen::Vector3d v =
        (at(state.t + kStep).translation() - at(state.t - kStep).translation()) / (2.0 * kStep);
    EXPECT_LT((state.velocity.head<3>() - v).norm(), 1e-3 * std::max(v.norm(), 0.05));
  }
}

TEST(StatesOf, rememberWhereTheyCameFrom) {
  const ScreenReport report = screenPoses(motions(1));
  const std::vector<StampedPose>& observed = report.motions[0].of(StreamKind::kCamera);
  for (const State& state : statesOf(report.motions, StreamKind::kCommand, kLag))
    for (std::size_t i = 0; i < kSpans.size(); ++i) {
      const double from = std::max(state.t - kSpans[i], observed.front().t);
      const Eigen::Isometry3d before = kOffset.inverse() * toldAt(0, from - kLag);
      const Eigen::Vector3d way = state.pair.observed.translation() - before.translation();
      EXPECT_LT((state.drift[i].head<3>() * kSpans[i] - way).norm(), 2e-3) << "one observation late at most";
    }
}

TEST(CleanStates, rejectsWhatNoRobotDoes) {
  std::vector<State> states = statesOf(screenPoses(motions(5)).motions, StreamKind::kCommand, kLag);
  base::Random random(3, "dirt");
  const auto shake = [&](double size) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(random.normal(0, 1), random.normal(0, 1), random.normal(0, 1));
  };
  for (State& state : states) state.pair.observed.translation() += shake(0.0005);
  std::vector<std::size_t> jumped;
  for (std::size_t k = 0; k < states.size(); k += 17) {
    if (states[k].motion == 4) continue;
    states[k].pair.observed.translation() += Eigen::Vector3d(0.1, 0.0, 0.0);
    jumped.push_back(k);
  }
  states[5].velocity.head<3>() *= 100.0;
  states[6].velocity[4] = 50.0;
  std::size_t of_last = 0;
  for (State& state : states)
    if (state.motion == 4 && of_last++ > 10)
      state.pair.observed = Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitX()) * state.pair.observed;
  const CleaningReport report = cleanStates(states);
  EXPECT_LT(std::sqrt(squaredDistance(report.offset, kOffset, kLever)), 5e-4);
  for (const std::size_t k : jumped) EXPECT_EQ(report.reason[k], Reason::kOutlier);
  EXPECT_EQ(report.reason[5], Reason::kTooFast);
  EXPECT_EQ(report.reason[6], Reason::kTurnsTooFast);
  for (std::size_t k = 0; k < states.size(); ++k)
    EXPECT_FALSE(states[k].motion == 4 && report.reason[k] == Reason::kNone) << "the whole trajectory goes";
  EXPECT_GT(report.count(Reason::kTrajectory), 5U);
  const std::vector<State> clean = kept(states, report);
  EXPECT_EQ(clean.size(), report.kept());
  EXPECT_GT(clean.size(), 900U);
}

TEST(CleanStates, standsNoneAtAll) {
  const CleaningReport report = cleanStates({});
  EXPECT_TRUE(report.reason.empty());
  EXPECT_TRUE(report.offset.isApprox(Eigen::Isometry3d::Identity()));
}

}  // namespace
}  // namespace capstan::learning
