// A failed motor encoder's segment of a recording is no part of what identification sees.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/identification/dual_ukf.h"
#include "core/identification/identification_data.h"
#include "core/identification/live_recording.h"
#include "core/identification/parameters.h"
#include "core/live/motor_failures.h"
#include "core/simulation/simulated_source.h"
#include "core/simulation/simulation_request.h"

namespace capstan::identification {
namespace {

using live::FailingMotors;
using tracking::MotorFault;

simulation::SimulatedSource sinusoid(double duration) {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = duration;
  request.images = false;
  return simulation::SimulatedSource(simulation::optionsOf(request));
}

IdentificationData recorded(double duration, const std::vector<live::MotorFailure>& failures) {
  simulation::SimulatedSource source = sinusoid(duration);
  FailingMotors failing(source, failures);
  return collect(failing);
}

/// What is left lies before `end` and is what the healthy recording holds there.
void expectBeginning(const IdentificationData& found, const IdentificationData& healthy, double end) {
  ASSERT_GT(found.motors.size(), 0U);
  EXPECT_EQ(found.motors.size() + found.excluded, healthy.motors.size());
  EXPECT_EQ(found.motors.velocity.size(), found.motors.size());
  EXPECT_LE(found.motors.t.back(), end);
  for (std::size_t i = 0; i < found.motors.size(); ++i)
    ASSERT_EQ(found.motors.position[i], healthy.motors.position[i]) << found.motors.t[i];
  ASSERT_GT(found.cameras.size(), 10U);
  EXPECT_LE(found.cameras.back().t, found.motors.t.back());
  for (std::size_t i = 0; i < found.cameras.size(); ++i)
    ASSERT_EQ(found.cameras[i].tip, healthy.cameras[i].tip) << found.cameras[i].t;
}

TEST(FailedMotor, LeavesTheRecordingBeforeIt) {
  constexpr double kFailure = 4.0, kDuration = 9.0;
  const IdentificationData healthy = recorded(kDuration, {});
  EXPECT_EQ(healthy.excluded, 0U);
  EXPECT_GE(healthy.motors.t.back(), kDuration);
  for (int motor = 0; motor < 3; ++motor)
    for (const MotorFault fault : {MotorFault::kLost, MotorFault::kFrozen}) {
      SCOPED_TRACE(fmt::format("motor {}, {}", motor + 1, base::nameOf(fault)));
      const IdentificationData found = recorded(kDuration, {{motor, kFailure, fault}});
      expectBeginning(found, healthy, kFailure);
      EXPECT_GT(found.motors.t.back(), kFailure - 0.2) << "frozen: back to where the count last moved";
    }
}

TEST(FailedMotor, IsAGapWhereItComesBack) {
  simulation::SimulatedSource source = sinusoid(9.0);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(source.info());
  DataCollector collector(pipeline, "gap");
  LiveRecording live("gap");
  live.begin(pipeline);
  tracking::Sample sample;
  bool failed = false;
  while (source.next(sample)) {
    const tracking::Snapshot& s = pipeline.step(sample);
    collector.add(sample, s);
    live.take(sample, s);
    if (const bool now = s.t > 3.0 && s.t < 5.0; now != failed) pipeline.setMotorFailed(1, failed = now);
  }
  const IdentificationData found = collector.finish(), held = live.data();
  EXPECT_EQ(held.motors.t, found.motors.t);
  ASSERT_EQ(held.cameras.size(), found.cameras.size());
  EXPECT_EQ(live.extent().motors, found.motors.size());
  EXPECT_NEAR(static_cast<double>(found.excluded), 2000.0, 3.0);
  for (const double t : found.motors.t) EXPECT_TRUE(t < 3.002 || t > 4.998) << t;
  std::size_t before = 0, after = 0;
  for (const CameraObservation& seen : found.cameras) {
    EXPECT_TRUE(seen.t < 3.002 || seen.t > 4.998) << seen.t;
    ++(seen.t < 4.0 ? before : after);
  }
  EXPECT_GT(before, 40U);
  EXPECT_GT(after, 50U);
}

TEST(FailedMotor, AMomentWithoutNumbersIsLeftOutAndTheCamerasBesideItStay) {
  simulation::SimulatedSource source = sinusoid(6.0);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(source.info());
  DataCollector collector(pipeline, "moment");
  tracking::Sample sample;
  while (source.next(sample)) {
    if (auto* motor = std::get_if<tracking::MotorSample>(&sample); motor && motor->t > 3.0 && motor->t < 3.02)
      motor->position(1) = motor->velocity(1) = std::numeric_limits<double>::quiet_NaN();
    collector.add(sample, pipeline.step(sample));
  }
  const IdentificationData found = collector.finish(), healthy = recorded(6.0, {});
  EXPECT_NEAR(static_cast<double>(found.excluded), 20.0, 2.0);
  for (const double t : found.motors.t) EXPECT_TRUE(t < 3.001 || t > 3.019) << t;
  EXPECT_EQ(found.cameras.size(), healthy.cameras.size());
}

TEST(FailedMotor, ALiveRecordingStopsThereAndSaysSo) {
  simulation::SimulatedSource source = sinusoid(9.0);
  FailingMotors failing(source, {{0, 4.0, MotorFault::kFrozen}});
  tracking::TrackingPipeline pipeline = tracking::makePipeline(source.info());
  LiveRecording live("live");
  live.begin(pipeline);
  tracking::Sample sample;
  for (int i = 0; failing.next(sample); ++i) {
    live.take(sample, pipeline.step(sample));
    if (i % 1700 == 0) live.data();
  }
  const IdentificationData held = live.data();
  EXPECT_LE(held.motors.t.back(), 4.0);
  EXPECT_LE(held.cameras.back().t, 4.0);
  EXPECT_TRUE(live.extent().motor_failed);
  EXPECT_NE(wordsOf(live.extent()).find("A motor encoder has failed"), std::string::npos);
  LiveExtent never;
  never.motor_failed = true;
  EXPECT_NE(wordsOf(never).find("Nothing can be identified"), std::string::npos);
}

TEST(FailedMotor, ThePulleyIsStillFound) {
  const IdentificationData data = recorded(40.0, {{0, 30.0, MotorFault::kFrozen}});
  const ParameterSet set(data.robot, "r_l1");
  const DualUkfReport report = identifyDualUkf(data, set);
  EXPECT_LT(report.estimates[0].low(), 0.059);
  EXPECT_GT(report.estimates[0].high(), 0.059);
  EXPECT_NEAR(report.estimates[0].value(), 0.059, 0.003 * 0.059);
}

}  // namespace
}  // namespace capstan::identification
