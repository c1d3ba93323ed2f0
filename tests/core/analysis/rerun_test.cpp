#include "core/analysis/rerun.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::analysis {
namespace {

simulation::SimulatedSource session() {
  simulation::SimulationRequest request;
  request.duration = 8.0;
  request.images = false;
  return simulation::SimulatedSource(simulation::optionsOf(request));
}

struct Outcome {
  tracking::TrackReport report;
  std::vector<Eigen::Vector3d> estimates;
};

Outcome run(const RerunChange& change, double until = std::numeric_limits<double>::infinity()) {
  simulation::SimulatedSource source = session();
  base::Progress progress;
  Outcome outcome;
  outcome.report = rerun(
      source, source.info(), change, progress,
      [&](const tracking::Snapshot& s) { outcome.estimates.push_back(s.q_link_ukf); }, until);
  return outcome;
}

TEST(RerunTest, WithoutAChangeItIsTheSession) {
  simulation::SimulatedSource source = session();
  tracking::TrackingPipeline pipeline =
      tracking::makePipeline(source.info(), tracking::trackingOptionsOf(source.info()));
  std::vector<Eigen::Vector3d> estimates;
  tracking::trackAll(
      source, pipeline, nullptr, 0.0,
      [&](const tracking::Sample&, const tracking::Snapshot& s) { estimates.push_back(s.q_link_ukf); });
  const Outcome again = run({});
  ASSERT_EQ(again.estimates.size(), estimates.size());
  for (std::size_t i = estimates.size() / 2; i < estimates.size(); i += 97)
    EXPECT_EQ(again.estimates[i], estimates[i]) << i;
}

TEST(RerunTest, EveryChangeReachesTheFilter) {
  const Outcome before = run({});
  std::vector<RerunChange> changes(3);
  changes[0].filter = tracking::FilterKind::kSixState;
  changes[1].gate_probability = 0.6;
  changes[2].camera_delay = 0.02;
  for (const RerunChange& change : changes) {
    EXPECT_FALSE(change.empty());
    const Outcome after = run(change);
    ASSERT_EQ(after.estimates.size(), before.estimates.size());
    EXPECT_NE(after.estimates.back(), before.estimates.back()) << change.words();
  }
  EXPECT_EQ(changes[2].words(), "camera delay 20 ms");
  RerunChange ray;
  ray.one_camera = tracking::OneCamera::kRay;
  EXPECT_EQ(rerunSetup(session().info(), ray).options.one_camera, tracking::OneCamera::kRay);
}

TEST(RerunTest, EndsAtTheGivenTime) {
  const Outcome part = run({}, 3.0);
  EXPECT_NEAR(part.report.last_t, 3.0, 2e-3);
  EXPECT_LT(part.report.motor_samples, 3100U);
}

TEST(RerunTest, FilesThatCannotBeReadAreNamed) {
  RerunChange change;
  change.robot = "/nowhere/robot.yaml";
  EXPECT_THROW(run(change), base::InputError);
  change = {};
  change.options = "/nowhere/filter.yaml";
  EXPECT_THROW(run(change), base::InputError);
}

}  // namespace
}  // namespace capstan::analysis
