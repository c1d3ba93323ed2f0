#include "core/analysis/results_to_draw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/experiments/motion_collector.h"
#include "core/recording/export.h"
#include "core/simulation/simulation_request.h"

namespace capstan::analysis {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ResultsToDraw : public ::testing::Test {
 protected:
  ResultsToDraw() : folder_(fs::temp_directory_path() / ("capstan_to_draw_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ResultsToDraw() override { fs::remove_all(folder_); }

  fs::path folder_;
};

// RMS over three errors of 3, 4 and 0 in each joint: 5/√3.
TEST_F(ResultsToDraw, ASessionIsATrialWithItsErrors) {
  ErrorRun run{.title = "live", .begin = 1.0, .end = 3.0, .simulated = true};
  for (const double e : {3.0, 4.0, 0.0}) {
    const Eigen::Vector3d error = Eigen::Vector3d::Constant(e);
    run.errors.push_back(
        {run.begin + static_cast<double>(run.errors.size()), error, error, 0.1 * error, e == 4.0});
  }
  run.camera = {{1.0, experiments::noJoints(), Eigen::Vector3d::Constant(2.0)},
                {2.0, experiments::noJoints(), experiments::noJoints()}};
  run.trajectory.resize(2);
  run.trajectory[1].t = 2.5;
  const experiments::Results results = resultsOfErrors(run, "test");
  EXPECT_EQ(results.title, "live");
  EXPECT_TRUE(results.simulated);
  ASSERT_EQ(results.trials.size(), 1U);
  const experiments::TrialResult& trial = results.trials[0];
  EXPECT_TRUE(trial.reference);
  EXPECT_EQ(trial.duration(), 2.0);
  ASSERT_EQ(trial.trajectory.size(), 2U);
  EXPECT_EQ(trial.trajectory[1].t, 2.5);
  EXPECT_NEAR(trial.occluded_share, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(trial.rmsOf(experiments::Estimator::kKinematic)(0), 5.0 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(trial.rmsOf(experiments::Estimator::kUkf)(2), 0.5 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(trial.rmsOf(experiments::Estimator::kCamera)(1), 2.0) << "what is not known does not count";
  EXPECT_THAT(trial.counts, ElementsAre(3U, 3U, 1U, 3U));
  EXPECT_EQ(trial.errorsOf(experiments::Estimator::kUkf, 1).size(), 3U);
  run.own_kinematics = true;
  EXPECT_FALSE(resultsOfErrors(run, "test").trials[0].reference);
}

TEST(SessionMotion, KeepsTwentyPointsASecondWithTheCameraSampleBeforeEach) {
  experiments::SessionMotion motion;
  tracking::Snapshot s{};
  s.q_link_true = s.q_link_kin = s.q_link_ukf = s.q_link_ukf_sigma = Eigen::Vector3d::Zero();
  s.reference_paired = s.motor_updated = true;
  for (int ms = 0; ms <= 1000; ++ms) {
    s.t = 1e-3 * ms;
    s.q_link_ukf(0) = s.t;
    s.camera_updated = ms == 480;
    s.gate = ms < 600 ? tracking::Gate::kOpen : tracking::Gate::kBothLost;
    s.q_link_cam = Eigen::Vector3d::Constant(0.5);
    motion.take(s);
  }
  const auto points = motion.trajectory();
  ASSERT_EQ(points.size(), 21U);
  for (const experiments::TrajectoryPoint& point : points) {
    EXPECT_EQ(point.q_ukf(0), point.t);
    EXPECT_EQ(point.q_cam.allFinite(), std::abs(point.t - 0.5) < 0.01) << point.t;
    EXPECT_EQ(point.occluded, point.t > 0.599) << point.t;
  }
  motion.restart();
  EXPECT_TRUE(motion.trajectory().empty());
}

TEST(SessionMotion, HalvesItsRateWhenItIsFull) {
  experiments::SessionMotion motion(16);
  tracking::Snapshot s{};
  s.reference_paired = true;
  for (int ms = 0; ms < 5000; ms += 10) {
    s.t = 1e-3 * ms;
    motion.take(s);
  }
  const auto points = motion.trajectory();
  EXPECT_LE(points.size(), 16U);
  EXPECT_GE(points.size(), 8U);
  EXPECT_EQ(points.front().t, 0.0);
  EXPECT_GT(points.back().t, 4.0);
  for (std::size_t i = 2; i < points.size(); ++i)
    EXPECT_NEAR(points[i].t - points[i - 1].t, points[1].t - points[0].t, 0.011);
}

TEST_F(ResultsToDraw, NoTwoResultsHaveOneName) {
  std::vector<experiments::Results> all(4);
  for (std::size_t i = 0; i < 4; ++i) all[i].name = i == 2 ? "D" : "C";
  distinguish(all);
  EXPECT_EQ(all[0].name, "C");
  EXPECT_EQ(all[1].name, "C-B");
  EXPECT_EQ(all[2].name, "D");
  EXPECT_EQ(all[3].name, "C-C");
}

TEST_F(ResultsToDraw, FoldersOfResultsAreFoundByName) {
  try {
    (void)resultFolders(folder_);
    ADD_FAILURE() << "an empty folder holds results";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds no results.json"));
  }
  for (const char* name : {"B", "A"}) {
    fs::create_directories(folder_ / name);
    std::ofstream(folder_ / name / "results.json") << "{}";
  }
  fs::create_directories(folder_ / "C");
  EXPECT_THAT(resultFolders(folder_), ElementsAre(folder_ / "A", folder_ / "B"));
  EXPECT_THAT(resultFolders(folder_ / "B"), ElementsAre(folder_ / "B"));
}

TEST_F(ResultsToDraw, ARecordingIsTrackedWithItsOwnRobotOrAnother) {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = 3.0;
  request.images = false;
  simulation::SimulatedSource source(simulation::optionsOf(request));
  robot::Description robot = source.info().robot;
  recording::importRecording(source, folder_ / "my trial.capstan", recording::headerOf(source.info(), "now"));
  base::Progress progress;
  const experiments::Results own = resultsOfRecording(folder_ / "my trial.capstan", {}, "test", progress);
  EXPECT_EQ(own.name, "my-trial");
  EXPECT_EQ(own.title, "my trial.capstan");
  EXPECT_TRUE(own.simulated);
  ASSERT_EQ(own.trials.size(), 1U);
  EXPECT_GT(own.trials[0].trajectory.size(), 40U);
  robot.drives[0].link_radius *= 0.97;
  std::ofstream(folder_ / "mine.yaml") << robot::formatDescription(robot);
  const experiments::Results other =
      resultsOfRecording(folder_ / "my trial.capstan", folder_ / "mine.yaml", "test", progress);
  EXPECT_EQ(other.name, "my-trial-mine");
  EXPECT_EQ(other.title, "my trial.capstan, mine");
  // Of the robot that the filter assumes, as the window shows it.
  EXPECT_EQ(other.trials[0].rmsOf(experiments::Estimator::kKinematic),
            other.trials[0].rmsOf(experiments::Estimator::kIdentified));
  EXPECT_NE(other.trials[0].rmsOf(experiments::Estimator::kKinematic)(0),
            own.trials[0].rmsOf(experiments::Estimator::kKinematic)(0));
  const ErrorRun shown = trackErrors(folder_ / "my trial.capstan", folder_ / "mine.yaml", progress);
  EXPECT_EQ(shown.momentsOf(experiments::Estimator::kKinematic, TimeShare::kAll).rms(),
            other.trials[0].rmsOf(experiments::Estimator::kKinematic));
  EXPECT_EQ(other.trials[0].kinematic_robot, "mine.yaml");
}

}  // namespace
}  // namespace capstan::analysis
