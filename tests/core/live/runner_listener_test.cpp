// Who listens to the pipeline, and a robot that is exchanged while it runs.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/live/runner.h"
#include "core/recording/session_source.h"
#include "core/tracking/make_pipeline.h"
#include "tests/core/recording/session_samples.h"
#include "tests/support/counting_new.h"

namespace capstan::live {
namespace {

using namespace recording::testing;

/// Motors at 1 kHz that swing, joints with them, a tip that nobody sees at 15 Hz. Counts allocations of the
/// thread that runs it, between two of its samples.
class SwingingSource : public tracking::Source {
 public:
  explicit SwingingSource(double duration) {
    info_.title = "swinging";
    info_.robot = raven();
    info_.duration = duration;
    info_.reference = true;
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    const int part = part_++ % 3;
    if (part == 0) ++tick_;
    const double t = tick_ * 1e-3;
    if (t > info_.duration) return false;
    if (tick_ == kWarm && part == 0) before_ = test::allocations();
    if (tick_ == kWarm + kCounted && part == 0) allocated = test::allocations() - before_;
    if (part == 0)
      out = tracking::MotorSample{t, Eigen::Vector3d(80, -86, -480).array() + 10 * std::sin(t),
                                  Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    else if (part == 1 && tick_ % 66 == 0)
      out = tracking::TipSample{t, t, Eigen::Vector3d::Constant(kNaN)};
    else
      out = tracking::JointSample{t, {0.6, 1.6, 0.34}};
    return true;
  }
  void block(bool, bool) override {}

  static constexpr int kWarm = 1000, kCounted = 2000;
  std::size_t allocated = 1;

 private:
  tracking::SourceInfo info_;
  int tick_ = 0, part_ = 0;
  std::size_t before_ = 0;
};

struct Running {
  explicit Running(double duration) {
    auto made = std::make_unique<SwingingSource>(duration);
    source = made.get();
    auto pipeline = tracking::makePipeline(made->info());
    RunnerOptions options;
    options.speed = 0.0;
    runner = std::make_unique<Runner>(std::move(made), std::move(pipeline), options);
  }
  SwingingSource* source;
  std::unique_ptr<Runner> runner;
};

/// raven() with the shoulder's pulley 7 % smaller.
robot::Description otherRobot() {
  robot::Description robot = raven();
  robot.drives[0].link_radius *= 0.93;
  return robot;
}

TEST(RunnerListener, HearsEverySampleWithWhatThePipelineMadeOfIt) {
  const Running running(2.0);
  std::vector<double> times;
  std::size_t samples = 0;
  int begun = 0;
  running.runner->listen({[&](const auto& pipeline) {
                            ++begun;
                            EXPECT_EQ(pipeline.robot().name, raven().name);
                          },
                          [&](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                            ++samples;
                            if (std::holds_alternative<tracking::MotorSample>(sample)) {
                              EXPECT_EQ(std::get<tracking::MotorSample>(sample).t, snapshot.t);
                              times.push_back(snapshot.t);
                            }
                          }});
  running.runner->run();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(samples, 6000U);
  ASSERT_EQ(times.size(), 2000U);
  EXPECT_EQ(times.back(), 2.0);
}

TEST(RunnerListener, IsLetGo) {
  const Running running(2.0);
  auto heard = std::make_shared<int>(0);
  running.runner->listen({[](const auto&) {}, [heard](const auto&, const auto&) { ++*heard; }});
  running.runner->listen({});
  running.runner->run();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(*heard, 0);
  EXPECT_EQ(heard.use_count(), 1) << "what it held is free again";
}

TEST(RunnerListener, NobodyListeningNothingIsAllocated) {
  const Running running(4.0);
  running.runner->run();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(running.source->allocated, 0U);
}

TEST(RunnerRobot, IsExchangedFromTheNextSampleOnAndErrorsBeginAnew) {
  const Running running(4.0);
  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  tracking::Snapshot before, after;
  ASSERT_TRUE(running.runner->takeSnapshot(before));
  int begun = 0;
  running.runner->listen({[&](const auto&) { ++begun; }, [](const auto&, const auto&) {}});
  running.runner->setRobot(otherRobot(), "smaller");
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(begun, 2) << "once on listening, once for the other robot";
  EXPECT_EQ(running.runner->report().motor_samples, 0U);
  EXPECT_EQ(running.runner->robot().drives[0].link_radius, otherRobot().drives[0].link_radius);
  EXPECT_EQ(running.runner->info().robot.drives[0].link_radius, raven().drives[0].link_radius)
      << "the source's own stays known";

  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  ASSERT_TRUE(running.runner->takeSnapshot(after));
  const auto wanted = [](const robot::Description& robot, const tracking::Snapshot& snapshot) {
    const auto& drive = robot.drives[0];
    return robot.joints[0].homing +
           drive.motor_capstan_radius * snapshot.q_motor(0) / (drive.gear_ratio * drive.link_radius);
  };
  EXPECT_NEAR(before.q_link_kin(0), wanted(raven(), before), 1e-12);
  EXPECT_NEAR(after.q_link_kin(0), wanted(otherRobot(), after), 1e-12);
  EXPECT_EQ(running.runner->report().motor_samples, after.motor_samples) << "of the new one";
}

TEST(RunnerReport, RestartsWithANewRegistrationAndSaysSo) {
  using tracking::ReportStart;
  const Running running(4.0);
  const auto step = [&] {
    running.runner->stepFrame();
    ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  };
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.1, 0.2, 0.3));
  running.runner->setRegistration(pose);
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_EQ(running.runner->report().since, ReportStart::kBeginning) << "nothing was tracked before";
  const auto tracked = running.runner->report().motor_samples;
  EXPECT_GT(tracked, 0U);
  running.runner->setRegistration(pose);
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_GT(running.runner->report().motor_samples, tracked) << "the registration in use";
  const double t = running.runner->status().t;
  running.runner->setRegistration(Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.2, 0.31)));
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(running.runner->report().motor_samples, 0U);
  EXPECT_EQ(running.runner->report().since, ReportStart::kRegistration);
  ASSERT_NO_FATAL_FAILURE(step());
  EXPECT_GE(running.runner->report().first_t, t);
  EXPECT_EQ(running.runner->report().since, ReportStart::kRegistration);
  running.runner->setRobot(otherRobot(), "smaller");
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(running.runner->report().since, ReportStart::kRobot);
}

TEST(RunnerRobot, KeepsTheRegistrationAndStandsInRecordings) {
  const TemporaryFolder folder;
  Running running(3.0);
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.1, 0.2, 0.3));
  running.runner->setRegistration(pose);
  running.runner->startRecording(folder / "a.capstan",
                                 recording::headerOf(running.runner->info(), "2026-11-21"));
  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  running.runner->setRobot(otherRobot(), "r_l1 58.7 mm");
  std::optional<Eigen::Isometry3d> registration;
  running.runner->post([&](tracking::Source&, tracking::TrackingPipeline& pipeline) {
    registration = pipeline.registration();
  });
  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  ASSERT_TRUE(registration);
  EXPECT_EQ(registration->matrix(), pose.matrix());
  running.runner->startRecording(folder / "b.capstan",
                                 recording::headerOf(running.runner->info(), "2026-11-21"));
  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  running.runner.reset();  // files are closed in the background; only the runner's end waits for that
  const auto radius = [&](const char* name) {
    const auto header = recording::readSessionSummary(folder / name).header;
    return robot::parseDescription(header.robot, name).drives[0].link_radius;
  };
  EXPECT_EQ(radius("a.capstan"), raven().drives[0].link_radius) << "as it was when the recording began";
  EXPECT_EQ(radius("b.capstan"), otherRobot().drives[0].link_radius);
  const auto events = recording::readSessionEvents(folder / "a.capstan");
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const recording::SessionEvent& event) {
    return event.kind == "robot" && event.text == "r_l1 58.7 mm";
  }));
}

TEST(RunnerOptions, OfTheFilterAreExchangedAndStandInRecordings) {
  const TemporaryFolder folder;
  Running running(3.0);
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.1, 0.2, 0.3));
  running.runner->setRegistration(pose);
  running.runner->setRobot(otherRobot(), "smaller");
  const auto header = recording::headerOf(running.runner->info(), "2026-11-21");
  running.runner->startRecording(folder / "a.capstan", header);
  tracking::TrackingOptions options = running.runner->tracking();
  options.gate_probability = 0.9;
  running.runner->setTracking(options);
  std::optional<tracking::TrackingOptions> used;
  std::optional<Eigen::Isometry3d> registration;
  double radius = 0.0;
  running.runner->post([&](tracking::Source&, tracking::TrackingPipeline& pipeline) {
    used = pipeline.options();
    registration = pipeline.registration();
    radius = pipeline.robot().drives[0].link_radius;
  });
  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  EXPECT_EQ(used->gate_probability, 0.9);
  EXPECT_EQ(running.runner->tracking().gate_probability, 0.9);
  ASSERT_TRUE(registration);
  EXPECT_EQ(registration->matrix(), pose.matrix());
  EXPECT_EQ(radius, otherRobot().drives[0].link_radius) << "the robot stays";
  running.runner->startRecording(folder / "b.capstan", header);
  running.runner->stepFrame();
  ASSERT_TRUE(running.runner->waitUntilIdle(30.0));
  running.runner.reset();
  const auto gate = [&](const char* name) {
    const auto text = recording::readSessionSummary(folder / name).header.tracking;
    return base::readYaml<tracking::TrackingOptions>(text, name).gate_probability;
  };
  EXPECT_EQ(gate("a.capstan"), tracking::TrackingOptions{}.gate_probability);
  EXPECT_EQ(gate("b.capstan"), 0.9);
  const auto events = recording::readSessionEvents(folder / "a.capstan");
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const recording::SessionEvent& event) {
    return event.kind == "filter options" && event.text == "gate_probability: 0.9";
  }));
}

TEST(RunnerRobot, OneThatThePipelineCannotTakeChangesNothing) {
  const Running running(2.0);
  robot::Description robot = raven();
  robot.joints.pop_back();
  robot.drives.pop_back();
  robot.coupling = {{1.0, 0.0}, {0.1, 1.0}};
  EXPECT_THROW(running.runner->setRobot(robot, "two joints"), base::InputError);
  EXPECT_EQ(running.runner->robot().size(), 3);
}

}  // namespace
}  // namespace capstan::live
