#include "core/analysis/error_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/recording/export.h"
#include "core/recording/table_source.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/running_rms.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"
#include "tests/support/counting_new.h"

namespace capstan::analysis {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

tracking::Snapshot pairedAt(double t, tracking::Gate gate = tracking::Gate::kOpen) {
  tracking::Snapshot s;
  s.t = t;
  s.reference_paired = true;
  s.camera_samples = 1;
  s.gate = gate;
  s.q_link_true = {0.1, 0.2, 0.3};
  s.q_link_kin = s.q_link_true + Eigen::Vector3d::Constant(t);
  s.q_link_ukf = s.q_link_true - Eigen::Vector3d::Constant(t);
  return s;
}

TEST(ErrorCollector, KeepsEverySampleAndTellsOcclusion) {
  ErrorCollector collector;
  for (int i = 0; i < 2000; ++i)
    collector.take(pairedAt(1e-3 * i, i < 1000 ? tracking::Gate::kOpen : tracking::Gate::kLeftLost));
  const ErrorRun run = collector.run();
  ASSERT_EQ(run.errors.size(), 2000U);
  EXPECT_EQ(run.begin, 0.0);
  EXPECT_NEAR(run.end, 1.999, 1e-9);
  for (std::size_t i = 0; i < run.errors.size(); ++i) {
    const experiments::ErrorPoint& point = run.errors[i];
    EXPECT_NEAR(point.t, 1e-3 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(point.kinematic(2), point.t, 1e-12);
    EXPECT_NEAR(point.ukf(0), -point.t, 1e-12);
    EXPECT_EQ(point.occluded, i >= 1000);
  }
}

// Errors of k ms for k = 0…999 seen and 1000…1999 hidden: Σ k and Σ k² are known.
TEST(ErrorCollector, MomentsAreOfEverySampleHoweverFewAreKept) {
  ErrorCollector collector(64);
  for (int i = 0; i < 2000; ++i)
    collector.take(pairedAt(1e-3 * i, i < 1000 ? tracking::Gate::kOpen : tracking::Gate::kLeftLost));
  const ErrorRun run = collector.run();
  EXPECT_LE(run.errors.size(), 64U);
  const ErrorMoments &all = run.momentsOf(experiments::Estimator::kKinematic, TimeShare::kAll),
                     &seen = run.momentsOf(experiments::Estimator::kUkf, TimeShare::kVisible),
                     &hidden = run.momentsOf(experiments::Estimator::kUkf, TimeShare::kOccluded);
  EXPECT_EQ(all.n, 2000U);
  EXPECT_EQ(seen.n, 1000U);
  EXPECT_EQ(hidden.n, 1000U);
  EXPECT_NEAR(all.rms()(1), 1e-3 * std::sqrt(1999.0 * 2000.0 * 3999.0 / 6.0 / 2000.0), 1e-12);
  EXPECT_NEAR(seen.mean(false)(0), -1e-3 * 499.5, 1e-12);
  EXPECT_NEAR(hidden.mean(true)(2), 1e-3 * 1499.5, 1e-12);
  EXPECT_TRUE(std::isnan(run.momentsOf(experiments::Estimator::kCamera, TimeShare::kAll).rms()(0)));
}

TEST(ErrorCollector, HalvesItsRateWhereItsMemoryIsFull) {
  ErrorCollector collector(64);
  const std::size_t before = test::allocations();
  for (int i = 0; i < 5000; ++i) collector.take(pairedAt(1e-3 * i));
  EXPECT_EQ(test::allocations(), before);
  const ErrorRun run = collector.run();
  ASSERT_GT(run.errors.size(), 32U);
  ASSERT_LE(run.errors.size(), 64U);
  EXPECT_EQ(run.errors.front().t, 0.0);
  EXPECT_GT(run.errors.back().t, 4.9);
  const double step = run.errors[1].t;
  for (std::size_t i = 1; i < run.errors.size(); ++i)
    EXPECT_NEAR(run.errors[i].t - run.errors[i - 1].t, step, 1e-9) << i;
  collector.restart();
  EXPECT_TRUE(collector.run().errors.empty());
  for (int i = 0; i < 100; ++i) collector.take(pairedAt(1e-3 * i));
  EXPECT_EQ(collector.run().errors.size(), 50U) << "32 of the first 64, every other one behind them";
}

TEST(ErrorCollector, TakesTheCameraWhereTheFilterDid) {
  ErrorCollector collector;
  tracking::Snapshot s = pairedAt(1.0);
  s.reference_paired = false;
  s.camera_updated = true;
  s.t_cam = 0.95;
  s.q_link_cam = {1, 2, 3};
  s.q_link_true_cam = {1.5, 2, 2};
  collector.take(s);
  s.gate = tracking::Gate::kJump;
  collector.take(s);
  s.gate = tracking::Gate::kOpen;
  s.q_link_true_cam = experiments::noJoints();  // no reference at that time
  collector.take(s);
  const ErrorRun run = collector.run();
  ASSERT_EQ(run.camera.size(), 1U);
  EXPECT_EQ(run.camera[0].t, 0.95);
  EXPECT_EQ(run.camera[0].error, Eigen::Vector3d(-0.5, 0, 1));
  EXPECT_TRUE(run.errors.empty());
}

class ErrorRuns : public ::testing::Test {
 protected:
  ErrorRuns() : folder_(fs::temp_directory_path() / ("capstan_error_run_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ErrorRuns() override { fs::remove_all(folder_); }

  static std::unique_ptr<tracking::Source> simulated() {
    simulation::SimulationRequest request;
    request.trajectory = "sinusoid";
    request.duration = 4.0;
    request.images = false;
    return std::make_unique<simulation::SimulatedSource>(simulation::optionsOf(request));
  }
  fs::path session() const {
    const auto source = simulated();
    recording::importRecording(*source, folder_ / "trial.capstan",
                               recording::headerOf(source->info(), "today"));
    return folder_ / "trial.capstan";
  }
  template <class Work>
  static std::string faultOf(Work&& work) {
    try {
      work();
    } catch (const base::InputError& error) {
      EXPECT_FALSE(error.fault().remedy.empty()) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "accepted";
    return {};
  }

  fs::path folder_;
  base::Progress progress_;
};

TEST_F(ErrorRuns, OfARecordingAreThoseOfThePipeline) {
  const fs::path file = session();
  const ErrorRun run = trackErrors(file, {}, progress_);
  EXPECT_EQ(run.title, "trial.capstan");
  EXPECT_EQ(run.motion, "checksum " + base::checksumOfFile(file));
  EXPECT_GT(run.camera.size(), 30U);
  // The oracle: the pipeline itself, sample by sample.
  const auto source = recording::openRecording(file, robot::Description());
  auto pipeline = tracking::makePipeline(source->info());
  std::vector<std::pair<double, Eigen::Vector3d>> all;
  tracking::trackAll(*source, pipeline, nullptr, 0.0,
                     [&](const tracking::Sample&, const tracking::Snapshot& s) {
                       if (s.reference_paired) all.emplace_back(s.t, s.q_link_ukf - s.q_link_true);
                     });
  ASSERT_EQ(run.errors.size(), all.size()) << "every one";
  stats::RunningRms<3> rms;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].first, run.errors[i].t);
    EXPECT_EQ(all[i].second, run.errors[i].ukf);
    rms.add(all[i].second);
  }
  EXPECT_EQ(run.momentsOf(experiments::Estimator::kUkf, TimeShare::kAll).rms(), rms.value())
      << "to the last bit";
  EXPECT_EQ(run.kinematic_robot, "RAVEN-II left");
  EXPECT_EQ(run.filter_robot, run.kinematic_robot);
  EXPECT_GT(run.trajectory.size(), 60U);
}

TEST_F(ErrorRuns, ASessionIsOfTheMotionOfItsOwnFile) {
  const fs::path file = session();
  fs::copy_file(file, folder_ / "copy.capstan");
  std::ofstream(folder_ / "other.capstan") << "another";
  const ErrorRun recorded = trackErrors(file, {}, progress_);
  ErrorRun live{.title = "live", .motion = "session live"};
  EXPECT_FALSE(sameMotion(live, recorded));
  for (const char* own : {"trial.capstan", "copy.capstan"}) {
    live.files = {folder_ / "other.capstan", folder_ / own};
    EXPECT_TRUE(sameMotion(live, recorded)) << own;
    EXPECT_TRUE(sameMotion(recorded, live)) << own;
  }
  ErrorRun trial{.title = "C, recorded", .motion = recorded.motion};  // results know the bytes, not the file
  EXPECT_TRUE(sameMotion(live, trial));
  EXPECT_TRUE(sameMotion(trial, live));
  live.files = {folder_ / "other.capstan"};
  EXPECT_FALSE(sameMotion(live, recorded));
  EXPECT_FALSE(sameMotion(trial, live));
}

// A recording that carries an identified robot is told from one that carries the robot file of that name.
TEST_F(ErrorRuns, ARobotThatOnlyTheRecordingHasIsSaid) {
  const auto source = simulated();
  recording::SessionHeader header = recording::headerOf(source->info(), "today");
  robot::Description robot = source->info().robot;
  robot.drives[0].link_radius *= 0.95;
  header.robot = robot::formatDescription(robot);
  recording::importRecording(*source, folder_ / "own.capstan", header);
  EXPECT_EQ(trackErrors(folder_ / "own.capstan", {}, progress_).filter_robot,
            "RAVEN-II left (the recording's own)");
}

TEST_F(ErrorRuns, OfAnotherRobotAreOthers) {
  const fs::path file = session();
  robot::Description robot =
      recording::openRecording(file, robot::readDescription(base::resource("robots/raven2_left.yaml")))
          ->info()
          .robot;
  robot.drives[0].link_radius *= 0.95;
  std::ofstream(folder_ / "mine.yaml") << robot::formatDescription(robot);
  const ErrorRun own = trackErrors(file, {}, progress_);
  const ErrorRun other = trackErrors(file, folder_ / "mine.yaml", progress_);
  EXPECT_EQ(other.title, "trial.capstan, mine");
  EXPECT_EQ(other.filter_robot, "mine.yaml");
  EXPECT_EQ(other.kinematic_robot, "mine.yaml");
  EXPECT_EQ(other.motion, own.motion);
  ASSERT_EQ(other.errors.size(), own.errors.size());
  EXPECT_GT((other.errors[50].kinematic - own.errors[50].kinematic).norm(), 1e-3);
}

// The same bytes are the same motion, whatever the file is called and wherever they were tracked; no others
// are.
TEST_F(ErrorRuns, AMotionIsKnownByItsBytes) {
  const fs::path file = session();
  fs::copy_file(file, folder_ / "copy.capstan");
  const std::string motion = trackErrors(file, {}, progress_).motion;
  EXPECT_EQ(trackErrors(folder_ / "copy.capstan", {}, progress_).motion, motion);
  experiments::Results results;
  experiments::TrialResult& trial = results.trials.emplace_back();
  trial.name = "recorded";
  trial.inputs.recording = "trial.capstan, 7 bytes, " + motion;
  trial.errors.push_back({0.5, {1, 2, 3}, {1, 2, 3}, {4, 5, 6}, true});
  experiments::writeResults(results, folder_ / "R");
  EXPECT_EQ(readErrors(folder_ / "R").motion, motion);
  results.trials[0].inputs.recording = "trial.capstan, 7 bytes";  // as older results have it
  experiments::writeResults(results, folder_ / "older");
  EXPECT_EQ(readErrors(folder_ / "older").motion, "") << "another recording may have as many bytes";
  EXPECT_EQ(base::checksumOf(""), "cbf29ce484222325");  // the reference values of FNV-1a, 64 bit
  EXPECT_EQ(base::checksumOf("foobar"), "85944171f73967e8");
}

TEST_F(ErrorRuns, CancelEndsIt) {
  const fs::path file = session();
  progress_.cancel();
  EXPECT_LE(trackErrors(file, {}, progress_).errors.size(), 1U);
}

TEST_F(ErrorRuns, BadRecordingsSaySo) {
  EXPECT_THAT(faultOf([&] { trackErrors(folder_ / "none.capstan", {}, progress_); }),
              HasSubstr("none.capstan"));
  std::ofstream(folder_ / "plain.csv") << "t,q_m1,q_m2,q_m3\n0,1,2,3\n0.001,1,2,3\n";
  EXPECT_THAT(faultOf([&] { trackErrors(folder_ / "plain.csv", {}, progress_); }),
              HasSubstr("holds no joint encoders"));
  std::ofstream(folder_ / "odd.yaml") << "name: mine\n";
  EXPECT_THAT(faultOf([&] { trackErrors(session(), folder_ / "odd.yaml", progress_); }),
              HasSubstr("odd.yaml"));
}

TEST_F(ErrorRuns, AreReadFromResults) {
  experiments::Results results;
  results.name = "C";
  for (const char* name : {"first", "second"}) {
    experiments::TrialResult trial;
    trial.name = name;
    trial.seed = results.trials.size() + 1;
    trial.inputs.trajectory = "sinusoid";
    const double size = static_cast<double>(trial.seed);
    trial.errors.push_back({0.5, {size, 2, 3}, {1, 2, 3}, {4, 5, 6}, true});
    trial.errors.push_back({0.51, {size, 2, 3}, {1, 2, 3}, {4, 5, 6}, false});
    trial.camera.push_back({0.49, {1, 2, 3}, {7, 8, 9}});
    trial.camera.push_back({0.52, {1, 2, 3}, experiments::noJoints()});
    trial.rms[static_cast<std::size_t>(experiments::Estimator::kUkf)] = {
        4.5, 5.5, 6.5};  // over what the series excluded
    trial.counts[static_cast<std::size_t>(experiments::Estimator::kUkf)] = 20;
    results.trials.push_back(trial);
  }
  results.trials.emplace_back().name = "no reference";
  experiments::writeResults(results, folder_ / "C");
  const ErrorRun first = readErrors(folder_ / "C");
  EXPECT_EQ(first.title, "C, first");
  EXPECT_THAT(first.trials, ElementsAre("first", "second"));
  ASSERT_EQ(first.errors.size(), 2U);
  EXPECT_TRUE(first.errors[0].occluded);
  EXPECT_EQ(first.errors[0].ukf, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(first.camera.size(), 1U);
  EXPECT_EQ(first.end, 0.51);
  EXPECT_NEAR(first.momentsOf(experiments::Estimator::kUkf, TimeShare::kAll).rms()(0), 4.5, 1e-12);
  EXPECT_EQ(first.momentsOf(experiments::Estimator::kUkf, TimeShare::kAll).n, 20U);
  const ErrorRun second = readErrors(folder_ / "C", "second");
  EXPECT_EQ(second.errors[0].kinematic(0), 2.0);
  EXPECT_NE(second.motion, first.motion);
  EXPECT_THAT(faultOf([&] { readErrors(folder_ / "C", "third"); }),
              HasSubstr("Choose one of: first, second"));
  EXPECT_THAT(faultOf([&] { readErrors(folder_); }), HasSubstr("Choose one of its folders: C"));
  EXPECT_THAT(faultOf([&] { readErrors(folder_ / "none"); }), HasSubstr("results.json"));
  std::ofstream(folder_ / "C" / "series.json") << "{";
  EXPECT_THAT(faultOf([&] { readErrors(folder_ / "C"); }), HasSubstr("series.json"));
}

}  // namespace
}  // namespace capstan::analysis
