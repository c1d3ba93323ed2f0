// Section V of the GPR paper, small: does the correction correct, and can it be stopped and repeated?
#include "core/experiments/debridement_study.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/experiments/tool_rig.h"

namespace capstan::experiments {
namespace {

using learning::CorrectionMode;

DebridementStudyOptions small() {
  DebridementStudyOptions options;
  options.training.motions = 60;
  options.training.most_tilt = 0.4;
  options.training.correction.likelihood_points = 200;
  options.training.correction.inducing_points = 200;
  options.training.correction.fit.iterations = 25;
  options.arrival.locations = 5;
  options.arrival.repetitions = 3;
  options.task.fragments = 6;
  options.fragments_beyond = 3;
  return options;
}

const DebridementStudyReport& study() {
  static const DebridementStudyReport report = [] {
    base::Progress progress;
    DebridementStudyReport both = runDebridement(small(), progress);
    both.arrival = runArrival(small(), progress).arrival;
    return both;
  }();
  return report;
}

const ArrivalErrors& arrival(CorrectionMode mode) { return study().arrival[static_cast<std::size_t>(mode)]; }

TEST(DebridementStudy, learnsFromWhatCamerasSaw) {
  EXPECT_EQ(study().motions, 60U);
  EXPECT_GT(study().screened, 0U);
  EXPECT_GT(study().kept, study().states * 9 / 10);
  EXPECT_LT(study().kept, study().states);
  EXPECT_GT(study().clock_offset, 0.04);  // that of the stamps, and the arm's own
  EXPECT_LT(study().clock_offset, 0.08);
}

TEST(DebridementStudy, correctionArrivesNearer) {
  const double none = arrival(CorrectionMode::kNone).distance;
  EXPECT_EQ(arrival(CorrectionMode::kNone).arrived, 15);
  EXPECT_GT(none, 0.015);
  for (const CorrectionMode mode : {CorrectionMode::kEndPoint, CorrectionMode::kFullTrajectory}) {
    EXPECT_EQ(arrival(mode).arrived, 15);
    EXPECT_LT(arrival(mode).distance, none / 4.0) << base::nameOf(mode);
    EXPECT_LT(arrival(mode).angle, 0.6 * arrival(CorrectionMode::kNone).angle) << base::nameOf(mode);
  }
}

TEST(DebridementStudy, correctionClearsWhatOpenLoopMisses) {
  const DebridementSummary slow = study().summary(DebridementMethod::kReplanning),
                           fast = study().summary(DebridementMethod::kCorrected),
                           blind = study().summary(DebridementMethod::kOpenLoop);
  EXPECT_EQ(blind.cleared, 0);
  EXPECT_GE(slow.cleared, 5);
  EXPECT_GE(fast.cleared, 4);
  EXPECT_EQ(fast.observations, 0.0);
  EXPECT_GT(slow.observations, 5.0);
  const Speedup speedup = study().speedup();
  EXPECT_GT(speedup.interval.low, 1.5);
  EXPECT_TRUE(speedup.interval.contains(speedup.value));
  EXPECT_NEAR(speedup.value, slow.time / fast.time, 1e-9);
}

TEST(DebridementStudy, looksWhereTheCorrectionIsUnsure) {
  constexpr auto kLowConfidence = static_cast<std::size_t>(DebridementMethod::kWhereUncertain);
  const DebridementSummary on = summaryOf(study().runs[kLowConfidence]),
                           beyond = summaryOf(study().beyond[kLowConfidence]);
  EXPECT_EQ(beyond.fragments, 3);
  EXPECT_GT(beyond.observations, on.observations);
  EXPECT_GT(beyond.time, on.time);
}

TEST(DebridementStudy, correctedCommandsStayWithinTheArmsLimits) {
  const auto robot = robot::readDescription(base::resource("robots/raven2_left_tool.yaml"));
  const auto truth = simulation::readToolTruth(base::resource("truth/debridement.yaml"));
  TrainingOptions training = small().training;
  training.correction.fit.iterations = 5;
  const TrainedCorrection trained = trainedOn(recordTraining(robot, truth, training), training);
  const DebridementScene scene = debridementScene(robot);
  ToolRig rig(robot, truth, scene.start, 1);
  const robot::ToolKinematics kinematics(robot);
  base::Random random(5, "far");
  int shrunk = 0, nowhere = 0;
  for (int k = 0; k < 60; ++k) {
    const Eigen::Vector3d place(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                random.uniform(-0.2, 0.1));
    const auto motion = straightMotion(scene.pose({0, 0, 0}, 0.0), scene.pose(place, 0.0), 0.2, 10);
    const auto path = learning::correctedPath(
        trained.model, motion, {CorrectionMode::kFullTrajectory, rig.reachable(), rig.commanded()});
    for (const learning::CorrectedWaypoint& waypoint : path) {
      const auto q = kinematics.solve(waypoint.command, 0.0, rig.robot().commandedJoints());
      nowhere += waypoint.limit == learning::ReachLimit::kNowhere;
      shrunk += waypoint.limit == learning::ReachLimit::kCorrection ||
                waypoint.limit == learning::ReachLimit::kOffset;
      EXPECT_EQ(q.has_value(), waypoint.limit != learning::ReachLimit::kNowhere);
    }
    EXPECT_EQ(rig.follow(path), learning::withinReach(path));
    EXPECT_TRUE(kinematics.insideLimits(rig.robot().commandedJoints()));
  }
  EXPECT_GT(shrunk, 0);
  EXPECT_GT(nowhere, 0);
}

TEST(DebridementStudy, tablesNameThePapersNumbers) {
  const std::string arrivals = base::markdownOf(arrivalTable(study()));
  for (const char* cell : {"20.30 ± 0.80", "4.90 ± 1.50", "1.00 ± 0.70"})
    EXPECT_NE(arrivals.find(cell), std::string::npos) << cell;
  EXPECT_NE(base::markdownOf(debridementTable(study(), small())).find("15.8"), std::string::npos);
  EXPECT_NE(base::markdownOf(trainingTable(study())).find("303"), std::string::npos);
}

TEST(DebridementStudy, doesNotDependOnThreads) {
  DebridementStudyOptions options = small();
  options.training.motions = 12;
  options.training.correction.fit.iterations = 3;
  options.arrival.locations = 2, options.arrival.repetitions = 2;
  options.task.fragments = 2, options.fragments_beyond = 1;
  base::Progress progress;
  options.threads = 1;
  const DebridementStudyReport one = runDebridement(options, progress);
  const ArrivalReport arrival_of_one = runArrival(options, progress).arrival;
  options.threads = 3;
  const DebridementStudyReport three = runDebridement(options, progress);
  const ArrivalReport arrival_of_three = runArrival(options, progress).arrival;
  for (std::size_t k = 0; k < arrival_of_one.size(); ++k)
    EXPECT_NEAR(arrival_of_one[k].distance, arrival_of_three[k].distance, 1e-9);
  for (std::size_t k = 0; k < kDebridementMethods; ++k)
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_NEAR(one.runs[k][f].off, three.runs[k][f].off, 1e-9);
      EXPECT_NEAR(one.runs[k][f].time, three.runs[k][f].time, 1e-9);
    }
  options.seed = 2;
  EXPECT_NE(runArrival(options, progress).arrival[0].distance, arrival_of_one[0].distance);
}

TEST(DebridementStudy, canBeStopped) {
  base::Progress progress;
  progress.cancel();
  const DebridementStudyReport stopped = runDebridement(small(), progress);
  EXPECT_TRUE(stopped.cancelled);
  EXPECT_EQ(stopped.states, 0U);
  EXPECT_TRUE(stopped.runs[0].empty());
  DebridementStudyOptions endless = small();
  endless.training.motions = 100'000;
  base::Progress later;
  std::jthread stop([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    later.cancel();
  });
  EXPECT_TRUE(runDebridement(endless, later).cancelled);
}

TEST(DebridementStudy, refusesWhatMakesNoSense) {
  base::Progress progress;
  const auto refused = [&](auto change) {
    DebridementStudyOptions options = small();
    change(options);
    EXPECT_THROW(runDebridement(options, progress), base::InputError);
  };
  refused([](auto& o) { o.training.motions = 0; });
  refused([](auto& o) { o.training.speed = 0.0; });
  refused([](auto& o) { o.arrival.repetitions = 1; });
  refused([](auto& o) { o.arrival.waypoints = 1; });
  refused([](auto& o) { o.task.fragments = 0; });
  refused([](auto& o) { o.task.capture = -1.0; });
  refused([](auto& o) { o.threads = 0; });
  refused([](auto& o) { o.robot = base::resource("robots/raven2_left.yaml"); });
  refused([](auto& o) { o.truth = base::resource("truth/default.yaml"); });
  refused([](auto& o) { o.truth = "nowhere.yaml"; });
}

TEST(DebridementScene, motionsAreStraightAndEven) {
  const DebridementScene scene =
      debridementScene(robot::readDescription(base::resource("robots/raven2_left_tool.yaml")));
  const auto motion = straightMotion(scene.pose({0, 0, 0}, 0.0), scene.pose({0.03, 0.04, 0}, 0.1), 0.05, 11);
  ASSERT_EQ(motion.size(), 11U);
  EXPECT_NEAR(motion.back().t, 1.0, 1e-12);  // 5 cm at 5 cm/s
  for (const Eigen::Vector3d& v : {learning::plannedVelocities(motion)[0].head<3>().eval(),
                                   learning::plannedVelocities(motion)[10].head<3>().eval()})
    EXPECT_NEAR(v.norm(), 0.05, 1e-12);
  EXPECT_NEAR((scene.axes.transpose() * scene.axes - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(scene.axes.determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace capstan::experiments
