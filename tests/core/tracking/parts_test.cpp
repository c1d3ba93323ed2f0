#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/tracking/error_table.h"
#include "core/tracking/jump_gate.h"
#include "core/tracking/options.h"
#include "core/tracking/time_series.h"
#include "tests/support/folders.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(TimeSeries, InterpolatesALineExactlyWithinItsMemory) {
  TimeSeries series(8);
  EXPECT_FALSE(series.at(0.0, 1.0));
  for (int k = 0; k < 20; ++k) series.push(0.5 * k, Vector3d(k, -2.0 * k, 1.0));
  for (double t = 6.0; t <= 9.5; t += 0.125) {
    const auto value = series.at(t, 0.0);
    ASSERT_TRUE(value) << t;
    EXPECT_NEAR((*value)(0), 2.0 * t, 1e-12);
    EXPECT_NEAR((*value)(1), -4.0 * t, 1e-12);
  }
  EXPECT_FALSE(series.at(5.9, 0.0)) << "older than the memory";
  EXPECT_FALSE(series.at(9.6, 0.0));
  EXPECT_NEAR((*series.at(9.6, 0.2))(0), 19.2, 1e-12);
  EXPECT_EQ((*series.at(11.0, 2.0))(0), 20.0) << "no farther than one step beyond the newest";
  series.push(9.5, Vector3d::Constant(100.0));
  EXPECT_EQ((*series.at(9.5, 0.0))(0), 19.0) << "time must rise";
}

JumpGate gate() { return JumpGate(16.27, 3, Vector3d(0.1, 0.1, 0.01), Vector3d(0.15, 0.15, 0.02)); }
const Matrix3d kNoise = Vector3d(1e-6, 1e-6, 1e-8).asDiagonal();

TEST(JumpGate, TakesWhatTheFilterExpectsAndRefusesOneStranger) {
  JumpGate jump = gate();
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(jump.accept(0.066 * k, 3.0, Vector3d::Zero(), kNoise));
  EXPECT_FALSE(jump.accept(0.4, 500.0, Vector3d(0.1, 0.0, 0.0), kNoise));
  EXPECT_TRUE(jump.accept(0.466, 2.0, Vector3d::Zero(), kNoise));
}

TEST(JumpGate, AConstantDisagreementWithKinematicsIsNoJump) {
  JumpGate jump = gate();
  const Vector3d wrong_pulley(0.08, 0.01, 0.0);
  EXPECT_FALSE(jump.accept(0.0, 900.0, wrong_pulley, kNoise));
  EXPECT_FALSE(jump.accept(0.066, 900.0, wrong_pulley * 1.01, kNoise));
  for (int k = 2; k < 30; ++k)
    EXPECT_TRUE(jump.accept(0.066 * k, 900.0, wrong_pulley * (1.0 + 0.01 * k), kNoise)) << k;
  EXPECT_FALSE(jump.accept(2.0, 900.0, Vector3d(-0.1, 0.0, 0.0), kNoise)) << "another object";
  EXPECT_TRUE(jump.accept(2.066, 900.0, wrong_pulley * 1.3, kNoise)) << "the marker is back";
}

TEST(JumpGate, AfterALongOcclusionTheSameDisagreementIsTakenAtOnce) {
  JumpGate jump = gate();
  const Vector3d before(0.05, 0.0, 0.0), after(0.09, 0.01, 0.001);
  for (int k = 0; k < 4; ++k) jump.accept(0.066 * k, 900.0, before, kNoise);
  EXPECT_TRUE(jump.accept(10.0, 900.0, after, kNoise));
}

TEST(JumpGate, AnObjectFartherThanKinematicsCanBeWrongNeverPasses) {
  JumpGate jump = gate();
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(jump.accept(0.066 * k, 900.0, Vector3d(0.3, 0.0, 0.0), kNoise));
}

TEST(JumpGate, ANanInnovationIsRefused) {
  JumpGate jump = gate();
  EXPECT_FALSE(jump.accept(0.0, std::nan(""), Vector3d::Constant(std::nan("")), kNoise));
}

Snapshot paired(double kin, double ukf) {
  Snapshot snapshot;
  snapshot.reference_paired = true;
  snapshot.q_link_true.setConstant(1.0);
  snapshot.q_link_kin.setConstant(1.0 + kin);
  snapshot.q_link_ukf.setConstant(1.0 + ukf);
  return snapshot;
}

TEST(ErrorTable, CountsPairedReferencesAndAcceptedCamerasOnly) {
  ErrorTable table;
  table.add(paired(0.3, 0.0));
  table.add(paired(-0.4, 0.1));
  Snapshot camera;
  camera.camera_updated = true;
  camera.gate = Gate::kOpen;
  camera.q_link_true_cam.setZero();
  camera.q_link_cam = Vector3d(0.1, 0.2, 0.3);
  table.add(camera);
  camera.gate = Gate::kJump;
  table.add(camera);
  camera.gate = Gate::kOpen;
  camera.q_link_true_cam.setConstant(std::numeric_limits<double>::quiet_NaN());
  table.add(camera);
  EXPECT_EQ(table.kinematic().count(), 2u);
  EXPECT_EQ(table.camera().count(), 1u);
  EXPECT_NEAR(table.kinematic().value()(0), std::sqrt(0.125), 1e-15);
  EXPECT_NEAR(table.ukf().value()(2), std::sqrt(0.005), 1e-15);
  EXPECT_NEAR(table.camera().value()(1), 0.2, 1e-15);
  EXPECT_NE(table.text().find("q3 [mm]"), std::string::npos);
}

TEST(TrackingOptions, TheFileInResourcesHoldsTheDefaults) {
  const TrackingOptions file = readTrackingOptions(capstan::test::resourceFile("tracking/default.yaml"));
  EXPECT_EQ(base::writeYaml(file), base::writeYaml(TrackingOptions{}));
}

TEST(TrackingOptions, RefusesWhatIsOutOfRangeByName) {
  try {
    base::readYaml<TrackingOptions>("gate_probability: 7\n", "mine.yaml");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "mine.yaml");
    EXPECT_EQ(error.fault().line, 1);
    EXPECT_EQ(error.fault().key, "gate_probability");
  }
}

}  // namespace
}  // namespace capstan::tracking
