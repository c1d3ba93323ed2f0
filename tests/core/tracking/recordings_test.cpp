/// Recordings of others: an independent simulated robot, and the RAVEN-II's own software.
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/recording/table_source.h"
#include "tests/core/tracking/pipeline_scene.h"

namespace capstan::tracking {
namespace {

TrackReport trackFile(const std::filesystem::path& file, double& worst_kinematic_deg) {
  const auto robot = robot::readDescription(test::kResources + "/robots/raven2_left.yaml");
  const auto source = recording::openRecording(file, robot);
  TrackingPipeline pipeline = makePipeline(source->info());
  worst_kinematic_deg = 0.0;
  return trackAll(*source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    EXPECT_TRUE(s.motor_samples == 0 || s.q_link_ukf.allFinite());
    if (s.reference_paired)
      worst_kinematic_deg =
          std::max(worst_kinematic_deg,
                   base::toDegrees((s.q_link_kin - s.q_link_true).head<2>().cwiseAbs().maxCoeff()));
  });
}

TEST(Recordings, IndependentRobotIsTrackedBetterThanByKinematics) {
  const auto file = test::measured("plant/rec101.csv");
  if (!file) GTEST_SKIP() << "measured data is not here (CAPSTAN_DATA)";
  double worst = 0.0;
  const TrackReport report = trackFile(*file, worst);
  EXPECT_EQ(report.motor_samples, 40001u);
  EXPECT_EQ(report.errors.ukf().count(), 40001u);
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_LT(report.errors.ukf().value()(joint), report.errors.kinematic().value()(joint)) << joint;
    EXPECT_LT(report.errors.ukf().value()(joint), report.errors.camera().value()(joint)) << joint;
  }
  EXPECT_GT(report.gateShare(Gate::kOpen), 0.99);
  EXPECT_FALSE(report.own_kinematics);
}

TEST(Recordings, TheRobotsOwnMotorLogRunsToItsEnd) {
  const auto file = test::measured("raven2-motors/joints123.csv");
  if (!file) GTEST_SKIP() << "measured data is not here (CAPSTAN_DATA)";
  double worst = 0.0;
  const TrackReport report = trackFile(*file, worst);
  EXPECT_EQ(report.motor_samples, 19415u);
  EXPECT_EQ(report.errors.ukf().count(), 19415u);
  EXPECT_TRUE(report.own_kinematics);
  EXPECT_TRUE(std::isnan(report.neesMean())) << "an error needs a truth";
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(base::toMillimetres(report.errors.kinematic().value()(2)), 1e-3);
}

}  // namespace
}  // namespace capstan::tracking
