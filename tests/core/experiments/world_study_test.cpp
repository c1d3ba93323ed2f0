// Drawn worlds and their study: draws, coverage counted by hand, resumption.
#include "core/experiments/world_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/resource.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;

WorldStudyOptions shortStudy() {
  WorldStudyOptions options;
  options.worlds = 2;
  options.duration = 60.0;
  options.seed = 5;
  options.parameters = "r_l";  // all three: with one alone, the others' errors go into the camera pose and it
  options.truth = base::resource("truth/laboratory.yaml");
  options.trajectory = "sinusoid";
  return options;
}

TEST(Worlds, AreDrawnAroundTheirCentreWithTheSpreadAskedFor) {
  const simulation::Truth centre = simulation::readTruth(base::resource("truth/laboratory.yaml"));
  WorldSpread spread;
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 2000;
  for (int k = 0; k < kDraws; ++k) {
    const auto world =
        drawWorld(centre, Eigen::Vector3d(0.063, 0.056, 1.0), spread, static_cast<std::uint64_t>(k));
    const double log = std::log(*world.joints[1].link_radius / *centre.joints[1].link_radius);
    EXPECT_LE(std::abs(log), 2.0 * spread.link_radius + 1e-12);
    sum += log;
    squares += log * log;
  }
  // A normal cut off at two sigma (values beyond put onto the limit) has variance 0.9206 sigma².
  const double sigma = std::sqrt(0.9206) * spread.link_radius;
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 * sigma / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(squares / kDraws), sigma, 4.0 * sigma / std::sqrt(2.0 * kDraws));
}

TEST(Worlds, NoSpreadIsTheCentreAndARadiusLeftOpenIsNominal) {
  const simulation::Truth centre = simulation::matchedTruth();
  const WorldSpread none{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto world = drawWorld(centre, Eigen::Vector3d(0.063, 0.056, 1.0), none, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(world.joints[i].stiffness_factor, centre.joints[i].stiffness_factor);
    EXPECT_DOUBLE_EQ(*world.joints[i].link_radius, (std::array{0.063, 0.056, 1.0})[i]);
  }
  EXPECT_EQ(world.cameras.stamp_delay, 0.0);
}

TEST(Worlds, RecoveryIsCountedOverWorlds) {
  WorldStudy study;
  study.names = {"r_l1"};
  for (const double value : {1.01, 0.98, 1.2, 1.0}) {
    WorldEstimate one;
    one.truth = 1.0;
    one.value = {value, value};
    one.low = {value - 0.05, value - 0.001};
    one.high = {value + 0.05, value + 0.001};
    one.seen = {true, value < 1.1};
    study.worlds.push_back({.seed = 0, .parameters = {one}, .seconds = {}});
  }
  const Recovery dual = study.recovery(0, Method::kDualUkf), batch = study.recovery(0, Method::kBatch);
  EXPECT_EQ(dual.covered, 3);
  EXPECT_EQ(dual.seen, 4);
  EXPECT_NEAR(dual.median_error, 0.015, 1e-12);
  EXPECT_EQ(batch.covered, 1);
  EXPECT_EQ(batch.seen, 3);
  EXPECT_NEAR(batch.median_error, 0.01, 1e-12);
}

TEST(Worlds, AStudyGoesOnWhereItWasStoppedAndFindsThePulley) {
  const fs::path folder = fs::path(testing::TempDir()) / "capstan_worlds";
  fs::remove_all(folder);
  WorldStudyOptions options = shortStudy();
  options.out = folder;
  options.worlds = 1;
  base::Progress first;
  ASSERT_EQ(runWorldStudy(options, first).worlds.size(), 1U);
  const auto written = fs::last_write_time(folder / "worlds" / "world-5.json");
  options.worlds = 2;
  base::Progress second;
  const WorldStudy study = runWorldStudy(options, second);
  ASSERT_EQ(study.worlds.size(), 2U);
  EXPECT_EQ(fs::last_write_time(folder / "worlds" / "world-5.json"), written) << "not run again";
  for (const World& world : study.worlds) {
    const WorldEstimate& radius = world.parameters.at(0);
    EXPECT_NE(radius.truth, 0.063095);
    for (const double value : radius.value) EXPECT_NEAR(value / radius.truth, 1.0, 0.01);
  }
  fs::remove_all(folder);
}

TEST(Worlds, CancellingKeepsWhatIsDone) {
  base::Progress progress;
  progress.cancel();
  const WorldStudy study = runWorldStudy(shortStudy(), progress);
  EXPECT_TRUE(study.cancelled);
  EXPECT_TRUE(study.worlds.empty());
}

TEST(Worlds, UnknownParametersAreRefused) {
  WorldStudyOptions options = shortStudy();
  options.parameters = "r_l9";
  base::Progress progress;
  EXPECT_THROW(runWorldStudy(options, progress), base::InputError);
}

}  // namespace
}  // namespace capstan::experiments
