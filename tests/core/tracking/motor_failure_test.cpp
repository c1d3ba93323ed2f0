#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/live/motor_failures.h"
#include "core/robot/arm_dynamics.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/partial_kinematics.h"
#include "tests/core/tracking/cable_arm_scene.h"
#include "tests/core/tracking/pipeline_scene.h"
#include "tests/support/counting_malloc.h"
#include "tests/support/counting_new.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using live::FailingMotors;
using live::MotorFailure;
using simulation::SimulatedSource;
using test::simulated;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Matrix3d couplingOf(const CableArmConstants& c) {
  Matrix3d a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(i, j) = c.coupling[i][j];
  return a;
}

/// The constrained motion written out as one saddle-point system: M ddq − A_Fᵀ u = rest, ddq_F given.
Vector3d accelerationBySaddlePoint(const CableArmModel::State& x, const MotorState& motor, JointSet unknown,
                                   double decay) {
  static const robot::ArmDynamics dynamics(raven());
  const CableArmConstants c = cableArmConstants(raven());
  const Matrix3d a = couplingOf(c);
  Vector3d q(x(0), x(2), x(4)), dq(x(1), x(3), x(5)), out = q, tension = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) out(i) -= c.homing[i];
  for (int i = 0; i < 3; ++i) {
    if (contains(unknown, i)) continue;
    const double stretch = c.motor_scale[i] * motor.position(i) - c.link_radius[i] * a.row(i).dot(out);
    const double rate = c.motor_scale[i] * motor.velocity(i) - c.link_radius[i] * a.row(i).dot(dq);
    tension(i) = c.link_radius[i] *
                 (c.stiffness[i] * 2.0 * std::sinh(c.exponent[i] * stretch) + 2.0 * c.damping[i] * rate);
  }
  Vector3d rest = a.transpose() * tension - dynamics.bias<double>(q, dq);
  for (int i = 0; i < 3; ++i)
    rest(i) -= c.coulomb[i] * std::tanh(dq(i) * c.inverse_smoothing[i]) + c.viscous[i] * dq(i);
  Eigen::Matrix<double, 6, 6> system = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  system.topLeftCorner<3, 3>() = dynamics.massMatrix<double>(q);
  right.head<3>() = rest;
  for (int i = 0; i < 3; ++i) {
    system(3 + i, 3 + i) = 1.0;  // a known cable: no unknown force
    if (!contains(unknown, i)) continue;
    system.block<3, 1>(0, 3 + i) = -a.row(i).transpose();
    system.row(3 + i).setZero();
    system(3 + i, i) = 1.0;
    right(3 + i) = -decay * dq(i);
  }
  return Vector3d(system.fullPivLu().solve(right).head<3>());
}

TEST(UnknownMotor, TheKernelSolvesTheConstrainedMotion) {
  base::Random random(31);
  CableArmModel model(raven());
  const UnknownMotion motion{Vector3d::Ones(), 0.2};
  model.setUnknownMotion(motion);
  for (JointSet unknown = 1; unknown < 8; ++unknown)
    for (int trial = 0; trial < 50; ++trial) {
      test::ArmMoment now = test::randomMoment(random);
      now.begin.unknown = now.end.unknown = unknown;
      now.begin.blind = now.end.blind = 0.3;
      now.end.position = now.begin.position;
      now.end.velocity = now.begin.velocity;
      const Vector3d expected =
          accelerationBySaddlePoint(now.x, now.begin, unknown, motion.decay(now.begin.blind));
      for (int i = 0; i < 3; ++i)
        if (contains(unknown, i)) now.begin.position(i) = now.end.position(i) = kNan;
      const double dt = 1e-9;
      const auto next = model.propagateOne(now.x, CableArmModel::interval(now.begin, now.end), dt);
      for (int joint = 0; joint < 3; ++joint) {
        const double ddq = (next(2 * joint + 1) - now.x(2 * joint + 1)) / dt;
        EXPECT_NEAR(ddq, expected(joint), 1e-3 * std::max(1.0, std::abs(expected(joint))))
            << unknown << " joint " << joint;
      }
    }
}

TEST(UnknownMotor, TheSpeedsPredictionFollowsItsCorrelation) {
  const UnknownMotion motion{Vector3d(0.3, 0.5, 0.05), 0.2};
  double mean = 1.0, variance = 0.0;  // of a speed that was 1 for certain, in units of `speed`
  const double dt = 1e-5;
  for (int i = 0; i < 100000; ++i) {
    const double blind = (i + 0.5) * dt, decay = motion.decay(blind);
    mean -= decay * mean * dt;
    variance += (std::pow(motion.density(blind)(1) / 0.5, 2) - 2.0 * decay * variance) * dt;
    if (i % 20000 != 19999) continue;
    const double latency = (i + 1) * dt / motion.time, rho = (1.0 + latency) * std::exp(-latency);
    EXPECT_NEAR(mean, rho, 1e-4);
    EXPECT_NEAR(variance, 1.0 - rho * rho, 1e-3);
  }
}

TEST(PartialKinematics, KnownCablesAndTheReferenceForTheOthers) {
  const robot::Transmission transmission(raven());
  const PartialKinematics cables(transmission);
  const Vector3d q(0.6, 1.5, 0.33), wrong(0.1, 1.2, 0.5);
  for (JointSet unknown = 0; unknown < 8; ++unknown) {
    Vector3d motors = transmission.motorFromJoint(q);
    for (int i = 0; i < 3; ++i)
      if (contains(unknown, i)) motors(i) = transmission.motorFromJoint(wrong)(i);
    const Vector3d kinematic = transmission.jointFromMotor(motors);
    EXPECT_LT((cables.given(kinematic, unknown, q) - q).norm(), 1e-12) << unknown;
    const auto seen = cables.observe(kinematic, unknown, Vector3d(0.02, 0.01, 0.001));
    Eigen::Matrix<double, 6, 1> x;
    x << q(0), 0, q(1), 0, q(2), 0;
    EXPECT_LT((seen.measurement.h * x - seen.y).norm(), 1e-12) << "motors that are known speak of q";
  }
}

TEST(MotorFailure, IsReadFromText) {
  const auto all = live::parseMotorFailure("all@30:lost", "--fail-motor");
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].motor, 2);
  EXPECT_EQ(all[2].time, 30.0);
  EXPECT_EQ(all[2].fault, MotorFault::kLost);
  const auto one = live::parseMotorFailure("2@1.5", "--fail-motor");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].fault, MotorFault::kFrozen);
  for (const char* wrong : {"", "2", "4@1", "0@1", "2@", "2@x", "2@-1", "2@1:broken", "2:lost@1", "@1"}) try {
      live::parseMotorFailure(wrong, "--fail-motor");
      ADD_FAILURE() << wrong;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().key, "--fail-motor");
      EXPECT_EQ(error.fault().value, wrong);
    }
}

struct Outcome {
  TrackReport report;
  Vector3d worst_free = Vector3d::Zero();  ///< |error| from a second behind the failure on, tip observable
  std::array<double, 3> sigma_in_observation{}, sigma_blind{};
};

Outcome track(const std::vector<MotorFailure>& failures, double blind_from, double blind_to,
              const simulation::Truth& truth = simulation::matchedTruth()) {
  SimulatedSource source(simulated(truth, 14.0, false));
  FailingMotors failing(source, failures);
  TrackingPipeline pipeline = makePipeline(source.info());
  Outcome outcome;
  Sample sample;
  while (failing.next(sample)) {
    const Snapshot& s = pipeline.step(sample);
    source.block(s.t > blind_from && s.t<blind_to, s.t> blind_from && s.t < blind_to);
    outcome.report.add(s);
    EXPECT_TRUE(s.q_link_ukf.allFinite());
    for (std::size_t i = 0; i < 3; ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      if (s.t > blind_from - 0.2 && s.t < blind_from)
        outcome.sigma_in_observation[i] = s.q_link_ukf_sigma(joint);
      if (s.t > blind_to - 0.2 && s.t < blind_to) outcome.sigma_blind[i] = s.q_link_ukf_sigma(joint);
    }
    if (s.reference_paired && s.t > 4.0 && (s.t < blind_from || s.t > blind_to + 0.5))
      outcome.worst_free = outcome.worst_free.cwiseMax((s.q_link_ukf - s.q_link_true).cwiseAbs());
  }
  return outcome;
}

TEST(MotorFailure, ALostEncoderLeavesItsJointToTheCamera) {
  for (int motor = 0; motor < 3; ++motor) {
    const Outcome outcome = track({{motor, 3.0, MotorFault::kLost}}, 8.0, 10.0);
    const auto at = static_cast<std::size_t>(motor);
    EXPECT_EQ(outcome.report.motor_failed[at], MotorFault::kLost);
    EXPECT_NEAR(outcome.report.motor_failed_since[at], 3.1, 2e-3);
    EXPECT_EQ(outcome.report.late_dropped, 0u);
    EXPECT_GT(outcome.report.gateShare(Gate::kOpen), 0.8) << motor;
    EXPECT_LT(base::toDegrees(outcome.worst_free(0)), motor == 0 ? 7.0 : 0.1) << motor;
    EXPECT_LT(base::toDegrees(outcome.worst_free(1)), motor == 1 ? 7.0 : 1.5) << motor;
    EXPECT_LT(base::toMillimetres(outcome.worst_free(2)), motor == 2 ? 12.0 : 3.0) << motor;
    for (std::size_t joint = 0; joint < 3; ++joint)
      if (joint == at) {
        EXPECT_GT(outcome.sigma_blind[joint], 3.0 * outcome.sigma_in_observation[joint]) << "it may wander";
      } else if (joint < at) {
        EXPECT_LT(outcome.sigma_blind[joint], 2.0 * outcome.sigma_in_observation[joint])
            << "its own motor holds it";
      }
  }
}

TEST(MotorFailure, AFrozenCountIsFoundByTheCameraAndNothingElseIs) {
  for (int motor = 0; motor < 3; ++motor) {
    const Outcome outcome = track({{motor, 3.0, MotorFault::kFrozen}}, 99.0, 99.0);
    for (int other = 0; other < 3; ++other)
      EXPECT_EQ(outcome.report.motor_failed[static_cast<std::size_t>(other)],
                other == motor ? MotorFault::kFrozen : MotorFault::kNone)
          << motor << " " << other;
    const double since = outcome.report.motor_failed_since[static_cast<std::size_t>(motor)];
    EXPECT_GT(since, 3.0);
    EXPECT_LT(since, 6.0);
  }
}

TEST(MotorFailure, AHealthyRobotOfAnotherModelIsNotAccused) {
  for (const std::uint64_t seed : {1u, 2u}) {
    auto options = simulated(simulation::defaultTruth(), 60.0, false);
    options.trajectory.kind = simulation::TrajectoryKind::kBlockTransfer;  // with rests, pulleys 6 % off
    options.seed = seed;
    SimulatedSource source(options);
    TrackingPipeline pipeline = makePipeline(source.info());
    const TrackReport report = trackAll(source, pipeline);
    for (const MotorFault fault : report.motor_failed) EXPECT_EQ(fault, MotorFault::kNone);
  }
}

TEST(MotorFailure, AGapOfMissingNumbersIsNoFailure) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 6.0, false));
  TrackingPipeline pipeline = makePipeline(source.info());
  for (Sample& sample : test::samplesOf(source)) {
    if (auto* motor = std::get_if<MotorSample>(&sample); motor && motor->t > 3.0 && motor->t < 3.05)
      motor->position(1) = motor->velocity(1) = kNan;
    pipeline.step(sample);
    if (pipeline.snapshot().t > 3.01 && pipeline.snapshot().t < 3.04) {
      EXPECT_TRUE(std::isnan(pipeline.snapshot().q_link_kin(1)));
    }
  }
  const Snapshot& s = pipeline.snapshot();
  EXPECT_FALSE(anyMotorFailed(s));
  EXPECT_EQ(s.motor_refused, 0u);
  EXPECT_TRUE(s.q_link_kin.allFinite());
  EXPECT_LT(base::toDegrees(std::abs(s.q_link_ukf(1) - s.q_link_true(1))), 0.1);
}

TEST(MotorFailure, ASilenceOfAllMotorsIsNoFailure) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 10.0, false));
  TrackingPipeline pipeline = makePipeline(source.info());
  Sample sample;
  double largest = 0.0;
  while (source.next(sample)) {
    const auto* motor = std::get_if<MotorSample>(&sample);
    if (motor && motor->t > 3.0 && motor->t < 5.0) continue;  // the cameras go on seeing the arm move
    const Snapshot& s = pipeline.step(sample);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(s.motor_failed[k], MotorFault::kNone) << k << " at " << s.t;
    if (s.t > 6.0 && s.reference_paired)
      largest = std::max(largest, (s.q_link_ukf - s.q_link_true).cwiseAbs()(2));
  }
  EXPECT_LT(largest, 2e-3) << "insertion [m]: as without the silence";
}

TEST(MotorFailure, DeclaredAndTakenBack) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 6.0, false));
  const std::vector<Sample> samples = test::samplesOf(source);
  TrackingPipeline pipeline = makePipeline(source.info());
  pipeline.setMotorFailed(0, true);
  for (const Sample& sample : samples) {
    const Snapshot& s = pipeline.step(sample);
    if (!s.motor_updated) continue;
    EXPECT_EQ(s.motor_failed[0], MotorFault::kDeclared);
    EXPECT_TRUE(std::isnan(s.q_link_kin(0)) && std::isfinite(s.q_link_kin(1)));
  }
  EXPECT_LT(base::toDegrees(std::abs(pipeline.snapshot().q_link_ukf(0) - pipeline.snapshot().q_link_true(0))),
            6.0)
      << "found by the camera from anywhere in its range";
  pipeline.reset();
  EXPECT_EQ(pipeline.snapshot().motor_failed[0], MotorFault::kDeclared);
  pipeline.setMotorFailed(0, false);
  TrackingPipeline untouched = makePipeline(source.info());
  for (const Sample& sample : samples) {
    pipeline.step(sample);
    untouched.step(sample);
  }
  EXPECT_EQ(pipeline.snapshot().q_link_ukf, untouched.snapshot().q_link_ukf);
}

TEST(MotorFailure, AllLostWithoutCameraDriftsWithGrowingSigmaAndStaysFinite) {
  const Outcome outcome = track(
      {{0, 3.0, MotorFault::kLost}, {1, 3.0, MotorFault::kLost}, {2, 3.0, MotorFault::kLost}}, 6.0, 13.0);
  for (std::size_t joint = 0; joint < 3; ++joint)
    EXPECT_GT(outcome.sigma_blind[joint], 5.0 * outcome.sigma_in_observation[joint]);
  EXPECT_EQ(outcome.report.late_dropped, 0u);
}

TEST(MotorFailure, NothingIsAllocatedWhenEncodersFail) {
  SimulatedSource source(simulated(simulation::defaultTruth(), 6.0, true));
  FailingMotors failing(source, {{0, 2.0, MotorFault::kFrozen}, {1, 3.0, MotorFault::kLost}});
  TrackingPipeline pipeline = makePipeline(source.info());
  std::size_t news = 0, mallocs = 0;
  bool blocked = false;
  Sample sample;
  while (failing.next(sample)) {
    const std::size_t new_before = capstan::test::allocations(), malloc_before = capstan::test::mallocs();
    const Snapshot& s = pipeline.step(sample);
    if (s.t > 0.5) {
      news += capstan::test::allocations() - new_before;
      mallocs += capstan::test::mallocs() - malloc_before;
    }
    if (s.t > 5.0 && !blocked) source.block(blocked = true, true);
  }
  EXPECT_EQ(pipeline.snapshot().motor_failed[0], MotorFault::kFrozen);
  EXPECT_EQ(pipeline.snapshot().motor_failed[1], MotorFault::kLost);
  EXPECT_EQ(news, 0u);
  EXPECT_EQ(mallocs, 0u);
}

TEST(CameraDelay, TakingALateClockForWhatItIsRestoresTheEstimate) {
  simulation::Truth late = simulation::matchedTruth();
  late.cameras.stamp_delay = 0.03;
  SimulatedSource source(simulated(late, 10.0, false));
  const std::vector<Sample> samples = test::samplesOf(source);
  TrackingOptions corrected;
  corrected.camera_delay = 0.03;
  TrackingPipeline as_stamped = makePipeline(source.info()),
                   as_exposed = makePipeline(source.info(), corrected);
  test::ListSource first(samples), second(samples);
  const Vector3d before = trackAll(first, as_stamped).errors.camera().value(),
                 after = trackAll(second, as_exposed).errors.camera().value();
  SimulatedSource punctual(simulated(simulation::matchedTruth(), 10.0, false));
  TrackingPipeline reference = makePipeline(punctual.info());
  const Vector3d best = trackAll(punctual, reference).errors.camera().value();
  EXPECT_GT(before(1), 1.5 * best(1));
  for (int joint = 0; joint < 3; ++joint) EXPECT_NEAR(after(joint), best(joint), 0.1 * best(joint)) << joint;
}

}  // namespace
}  // namespace capstan::tracking
