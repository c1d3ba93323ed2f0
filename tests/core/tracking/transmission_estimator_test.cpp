#include "core/tracking/transmission_estimator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/random.h"
#include "core/session/occlusion.h"
#include "core/simulation/simulation_request.h"
#include "core/simulation/truth.h"
#include "tests/core/tracking/pipeline_scene.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::ListSource;
using test::samplesOf;

/// A block transfer of the default robot: joint 1 turns on a pulley of 59 mm where the robot file
/// says 63.095.
struct Session {
  session::SourceInfo info;
  std::vector<Sample> samples;
};

Session transfer(double duration, std::uint64_t seed, double occlusion = 0.0) {
  simulation::SimulationRequest request;
  request.duration = duration;
  request.images = false;
  request.seed = seed;
  simulation::SimulatedSource source(simulation::optionsOf(request));
  const session::OcclusionSchedule schedule{.percentage = occlusion};
  Session session{source.info(), {}};
  double t = 0.0;
  for (Sample sample; source.next(sample);) {
    if (const auto* motor = std::get_if<MotorSample>(&sample)) t = motor->t;
    source.block(schedule.blockedAt(t), schedule.blockedAt(t));
    session.samples.push_back(sample);
  }
  return session;
}

const Session& twoMinutes() {
  static const Session session = transfer(120.0, 31);
  return session;
}

struct Tracked {
  TrackReport report;
  Snapshot last;
};

/// Errors count from the time `from` on [s].
Tracked tracked(const Session& session, const robot::Description& robot, FilterKind filter,
                double from = 0.0) {
  session::SourceInfo info = session.info;
  info.robot = robot;
  TrackingOptions options;
  options.filter = filter;
  TrackingPipeline pipeline = makePipeline(info, options);
  ListSource source(session.samples);
  TrackReport report;
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (s.t >= from) report.add(s);
  });
  return {report, pipeline.snapshot()};
}

robot::Description withRadius(robot::Description robot, double radius) {
  robot.drives[0].link_radius = radius;
  return robot;
}

/// Motors that count `offset` [rad] more than they turned, from the first sample on.
Session withMotorOffset(Session session, const Vector3d& offset) {
  for (Sample& sample : session.samples)
    if (auto* motor = std::get_if<MotorSample>(&sample)) motor->position += offset;
  return session;
}

Session withMovedCamera(Session session, const Vector3d& shift) {
  for (Sample& sample : session.samples)
    if (auto* tip = std::get_if<TipSample>(&sample)) tip->position += shift;
  return session;
}

TEST(TransmissionEstimator, FindsAPulleyThatIsWrongAndBeatsBothInputs) {
  const Session& session = twoMinutes();
  const Tracked six = tracked(session, session.info.robot, FilterKind::kSixState);
  const Tracked augmented = tracked(session, session.info.robot, FilterKind::kAugmented);
  const Vector3d ukf = augmented.report.errors.ukf().value();
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_LT(ukf(joint), augmented.report.errors.kinematic().value()(joint)) << joint;
    EXPECT_LT(ukf(joint), augmented.report.errors.camera().value()(joint)) << joint;
  }
  EXPECT_LT(ukf(0), 0.2 * six.report.errors.ukf().value()(0));
  const TransmissionEstimate& found = augmented.last.transmission;
  EXPECT_TRUE(found.includesScale(0));
  EXPECT_NEAR(found.scale(0), 0.063095 / 0.059 - 1.0, 0.003);
  for (int joint = 0; joint < 3; ++joint) EXPECT_FALSE(found.includesOffset(joint)) << joint;
  EXPECT_FALSE(found.includesScale(1));
  EXPECT_FALSE(found.includesScale(2));
}

TEST(TransmissionEstimator, ARobotFileThatIsRightIsLeftAlone) {
  const Session& session = twoMinutes();
  const robot::Description robot = withRadius(session.info.robot, 0.059);
  const Tracked six = tracked(session, robot, FilterKind::kSixState);
  const Tracked augmented = tracked(session, robot, FilterKind::kAugmented);
  EXPECT_EQ(augmented.last.transmission.scale, Vector3d::Zero());
  EXPECT_EQ(augmented.last.transmission.offset, Vector3d::Zero());
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(augmented.report.errors.ukf().value()(joint), 1.05 * six.report.errors.ukf().value()(joint))
        << joint;
}

TEST(TransmissionEstimator, FindsAHomingOffset) {
  const Session& session = twoMinutes();
  const robot::Description robot = withRadius(session.info.robot, 0.059);
  const double metres = robot.drives[2].motor_capstan_radius / robot.drives[2].gear_ratio;
  const Session off = withMotorOffset(session, {0.0, 0.0, 3e-3 / metres});
  const Tracked augmented = tracked(off, robot, FilterKind::kAugmented);
  ASSERT_TRUE(augmented.last.transmission.includesOffset(2));
  EXPECT_NEAR(augmented.last.transmission.offset(2), -3e-3, 0.3e-3);
  EXPECT_LT(augmented.report.errors.ukf().value()(2), augmented.report.errors.kinematic().value()(2));
}

TEST(TransmissionEstimator, CamerasThatWereMovedAreNoTransmissionError) {
  const Session& session = twoMinutes();
  const robot::Description robot = withRadius(session.info.robot, 0.059);
  const Session moved = withMovedCamera(session, {-0.011, -0.005, 0.002});
  // As long as the arm rests, a pulley that is wrong and a camera that was moved look alike.
  constexpr double kHasMoved = 5.0;  // [s]
  const Tracked six = tracked(session, robot, FilterKind::kSixState, kHasMoved);
  const Tracked augmented = tracked(moved, robot, FilterKind::kAugmented, kHasMoved);
  EXPECT_GT(augmented.last.transmission.camera_moved_probability, 0.99);
  EXPECT_EQ(augmented.last.transmission.scale, Vector3d::Zero());
  EXPECT_EQ(augmented.last.transmission.offset, Vector3d::Zero());
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(augmented.report.errors.ukf().value()(joint), 1.05 * six.report.errors.ukf().value()(joint))
        << joint;
}

TEST(TransmissionEstimator, HoldsThroughOcclusionWithGrowingSigma) {
  for (const double occlusion : {40.0, 80.0}) {
    const Session session = transfer(120.0, 32, occlusion);
    const Tracked augmented = tracked(session, session.info.robot, FilterKind::kAugmented);
    for (int joint = 0; joint < 3; ++joint) {
      const double ukf = augmented.report.errors.ukf().value()(joint);
      EXPECT_LT(ukf, augmented.report.errors.kinematic().value()(joint)) << occlusion << " " << joint;
      EXPECT_LT(ukf, augmented.report.errors.camera().value()(joint)) << occlusion << " " << joint;
    }
  }
  Session blind = twoMinutes();
  std::erase_if(blind.samples, [](const Sample& sample) {
    const auto* tip = std::get_if<TipSample>(&sample);
    return tip && tip->t > 60.0;
  });
  TrackingPipeline pipeline = makePipeline(blind.info, TrackingOptions{});
  ListSource source(blind.samples);
  double early = 0.0, late = 0.0;
  Vector3d held = Vector3d::Zero();
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    // The sigma of a scale counts by the travel from the hard stop, where joint 1 is at zero.
    const double by_travel = s.q_link_ukf_sigma(0) / std::abs(s.q_link_kin(0));
    if (std::abs(s.t - 65.0) < 5e-4) early = by_travel, held = s.transmission.scale;
    if (std::abs(s.t - 115.0) < 5e-4) {
      late = by_travel;
      EXPECT_EQ(s.transmission.scale, held);
    }
  });
  EXPECT_GT(early, 0.0);
  EXPECT_GT(late, early);
}

TEST(WhiteNoise, IsMeasuredWhateverDriftsBeside) {
  base::Random random(5, "white");
  WhiteNoise noise(3000, 0.1);
  const Matrix3d stated = 25.0 * Matrix3d::Identity();
  const Vector3d sigma(0.2, 0.3, 2.0);
  for (int k = 0; k < 6000; ++k) {
    const double t = k / 15.0;
    const Vector3d drift(5.0 * std::sin(0.3 * t), 0.1 * t, -3.0);
    Vector3d residual = drift;
    for (int i = 0; i < 3; ++i) residual(i) += random.normal(0.0, sigma(i));
    noise.add(t, residual, stated);
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(std::sqrt(noise.value(stated)(i, i)), sigma(i), 0.06 * sigma(i)) << i;
}

TEST(WhiteNoise, KeepsWhatIsStatedUntilEnoughNeighboursWereSeen) {
  WhiteNoise noise(100, 0.1);
  const Matrix3d stated = 4.0 * Matrix3d::Identity();
  base::Random random(9, "neighbours");
  const auto add = [&](double t) { noise.add(t, Vector3d(random.normal(), 0.0, 0.0), stated); };
  for (int k = 0; k < 200; ++k) add(1.0 * k);  // gaps: no neighbours
  EXPECT_EQ(noise.value(stated), stated);
  for (int k = 0; k < WhiteNoise::kEnough + 1; ++k) add(300.0 + 0.05 * k);
  EXPECT_EQ(noise.value(stated), stated);
  add(300.0 + 0.05 * (WhiteNoise::kEnough + 1));
  EXPECT_NE(noise.value(stated), stated);
}

TEST(InnovationCovariance, MakesTheNisOfWhatFollowsOne) {
  base::Random random(7, "innovations");
  InnovationCovariance covariance(300);
  const Matrix3d predicted = 100.0 * Matrix3d::Identity();
  double sum = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const Vector3d innovation(random.normal(0.0, 0.1), random.normal(0.0, 2.0), random.normal(0.0, 0.5));
    const double nis = innovation.dot(covariance.value(predicted).llt().solve(innovation));
    if (k >= 1000) sum += nis / 3.0 / 4000.0;
    covariance.add(innovation, nis);
  }
  EXPECT_NEAR(sum, 1.0, 0.04);
}

}  // namespace
}  // namespace capstan::tracking
