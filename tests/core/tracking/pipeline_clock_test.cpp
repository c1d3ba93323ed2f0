// Time stamps as they should not be: cameras later than the memory, motor clocks that jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/simulation/truth.h"
#include "core/tracking/stray_readings.h"
#include "tests/core/tracking/pipeline_scene.h"

namespace capstan::tracking {
namespace {

using Eigen::Vector3d;
using simulation::SimulatedSource;
using test::ListSource;
using test::samplesOf;
using test::simulated;

double jointError(const Snapshot& s) {
  return (s.q_link_ukf - s.q_link_true).head<2>().cwiseAbs().maxCoeff();
}

TEST(PipelineClock, CamerasThatAreAlwaysTooLateLeaveKinematicsObserved) {
  simulation::Truth truth = simulation::matchedTruth();
  truth.cameras.latency = 0.6;
  SimulatedSource source(simulated(truth, 6.0, false));
  TrackingPipeline pipeline = makePipeline(source.info());
  double nis = 0.0, worst = 0.0;
  int updates = 0, cameras = 0;
  const TrackReport report = trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (s.nis != nis && std::isfinite(s.nis)) ++updates;
    nis = s.nis;
    if (s.t > 1.0) worst = std::max(worst, jointError(s));
    if (!s.camera_updated) return;
    ++cameras;
    EXPECT_EQ(s.gate, Gate::kLate);
  });
  ASSERT_GT(cameras, 60);
  EXPECT_EQ(report.late_dropped, report.camera_samples);
  EXPECT_EQ(report.gates[static_cast<std::size_t>(Gate::kLate)], report.camera_samples) << "not: no camera";
  EXPECT_NEAR(updates, 15.0 * (report.last_t - report.first_t), 6.0);
  EXPECT_LT(base::toDegrees(worst), 0.3);
}

/// Time of the last motor sample.
double endOf(const std::vector<Sample>& samples) {
  double t = 0.0;
  for (const Sample& sample : samples)
    if (const auto* motor = std::get_if<MotorSample>(&sample)) t = motor->t;
  return t;
}

/// Adds `shift` to the stamps of every sample from `from` on.
std::vector<Sample> shifted(std::vector<Sample> samples, double from, double shift) {
  for (Sample& sample : samples)
    std::visit(
        [&](auto& one) {
          if (one.t < from) return;
          one.t += shift;
          if constexpr (requires { one.t_arrival; }) one.t_arrival += shift;
        },
        sample);
  return samples;
}

TEST(PipelineClock, OneStampFarInTheFutureCostsAFewSamples) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 4.0, false));
  TrackingPipeline pipeline = makePipeline(source.info());
  std::vector<Sample> samples = samplesOf(source);
  std::uint64_t motors = 0;
  for (Sample& sample : samples)
    if (auto* motor = std::get_if<MotorSample>(&sample); motor && ++motors == 1500) motor->t += 1000.0;
  ListSource list(samples);
  const TrackReport report = trackAll(list, pipeline);
  const Snapshot& s = pipeline.snapshot();
  EXPECT_GT(s.motor_refused, 0u);
  EXPECT_LT(s.motor_refused, 20u);
  EXPECT_EQ(s.motor_refused + s.motor_samples, motors);
  EXPECT_EQ(s.t, endOf(samples));
  EXPECT_LT(base::toDegrees(jointError(s)), 0.2);
  EXPECT_GT(report.gateShare(Gate::kOpen), 0.95) << "the camera is observed again";
}

TEST(PipelineClock, AClockSetBackIsTheClockFromThenOn) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 6.0, false));
  TrackingPipeline pipeline = makePipeline(source.info());
  const std::vector<Sample> samples = shifted(samplesOf(source), 3.0, -2.5);
  ListSource list(samples);
  const TrackReport report = trackAll(list, pipeline);
  const Snapshot& s = pipeline.snapshot();
  EXPECT_LT(s.motor_refused, 20u);
  EXPECT_EQ(s.t, endOf(samples));
  EXPECT_LT(base::toDegrees(jointError(s)), 0.2);
  EXPECT_GT(report.gateShare(Gate::kOpen), 0.9);
  EXPECT_GT(report.errors.camera().count(), 70u) << "the reference is found at the camera's time again";
}

TEST(PipelineClock, ARepeatedOrStrayOldStampIsRefusedAndNothingElse) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 2.0, false));
  TrackingPipeline pipeline = makePipeline(source.info()), plain = makePipeline(source.info());
  std::uint64_t strays = 0;
  for (const Sample& sample : samplesOf(source)) {
    plain.step(sample);
    pipeline.step(sample);
    const auto* motor = std::get_if<MotorSample>(&sample);
    if (!motor) continue;
    for (const double back : {0.0, 0.003, 0.8}) {
      MotorSample stray = *motor;
      stray.t -= back;
      stray.position.setConstant(50.0);
      EXPECT_FALSE(pipeline.step(stray).motor_updated);
      ++strays;
    }
  }
  EXPECT_EQ(pipeline.snapshot().motor_refused, strays);
  EXPECT_EQ(pipeline.snapshot().q_link_ukf, plain.snapshot().q_link_ukf);
}

/// A damaged number between good ones moves nothing; an encoder that stays where it jumped to is believed.
TEST(PipelineClock, AReadingThatNoArmCanHaveIsNotUsed) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 4.0, false));
  const std::vector<Sample> samples = samplesOf(source);
  const auto jumpingAt = [&](double from, double to) {
    std::vector<Sample> changed = samples;
    for (Sample& sample : changed)
      if (auto* motor = std::get_if<MotorSample>(&sample); motor && motor->t >= from && motor->t < to)
        motor->position[0] += 9000.0;
    return changed;
  };
  const auto track = [&](std::vector<Sample> all) {
    TrackingPipeline pipeline = makePipeline(source.info());
    ListSource list(std::move(all));
    double worst = 0.0;
    trackAll(list, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
      if (s.t > 1.0) worst = std::max(worst, jointError(s));
    });
    return std::pair(worst, pipeline.snapshot().motor_stray);
  };
  const double undisturbed = track(samples).first;
  const auto [one, stray] = track(jumpingAt(1.9995, 2.0005));
  EXPECT_EQ(stray, 1U);
  EXPECT_NEAR(one, undisturbed, 1e-4);
  EXPECT_EQ(track(jumpingAt(2.0, 9.0)).second, static_cast<std::uint64_t>(StrayReadings::kToBelieve - 1));
}

/// Where the first reading is the damaged one, those after it are right; rows may come slowly.
TEST(PipelineClock, ADamagedFirstReadingDoesNotLoseTheEncoder) {
  for (const double rate : {10.0, 30.0, 1000.0}) {
    StrayReadings stray(robot::readDescriptionOrDefault({}));
    int taken_out = 0;
    for (int k = 0; k < 10; ++k) {
      MotorSample sample;
      sample.t = k / rate;
      sample.position = {k == 0 ? 1e6 : 80.0, -90.0, -480.0};
      taken_out += stray.takeOut(sample);
    }
    EXPECT_LE(taken_out / rate, 0.1) << rate << " rows/s: a longer gap is a lost encoder";
    EXPECT_LE(taken_out, StrayReadings::kToBelieve - 1);
  }
}

TEST(TrackReport, BegunInTheMiddleItCountsWhatFollows) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 4.0, false));
  TrackingPipeline pipeline = makePipeline(source.info());
  TrackReport report;
  std::uint64_t motors = 0, cameras = 0;
  bool second = false;
  for (const Sample& sample : samplesOf(source)) {
    const double t = std::visit([](const auto& one) { return one.t; }, sample);
    if (!second && t > 2.0) {
      report = {};
      second = true;
      motors = cameras = 0;
    }
    report.add(pipeline.step(sample));
    motors += std::holds_alternative<MotorSample>(sample);
    cameras += std::holds_alternative<TipSample>(sample);
  }
  report.add(pipeline.step(TipSample{0.3, 4.0, pipeline.snapshot().tip_ukf}));
  EXPECT_EQ(report.motor_samples, motors);
  EXPECT_EQ(report.camera_samples, cameras + 1);
  EXPECT_EQ(report.late_dropped, 1u);
  EXPECT_NEAR(report.first_t, 2.0, 0.01);
  EXPECT_EQ(report.last_t, pipeline.snapshot().t);
  std::uint64_t gates = 0;
  for (const std::uint64_t count : report.gates) gates += count;
  EXPECT_EQ(gates, report.camera_samples);
}

}  // namespace
}  // namespace capstan::tracking
