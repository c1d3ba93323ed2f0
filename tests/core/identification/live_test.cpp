// Identification beside a running session, driven sample by sample with a clock of its own.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/identification/live_identification.h"
#include "core/identification/live_text.h"
#include "core/simulation/simulated_source.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::identification {
namespace {

simulation::SimulatedSource sinusoid(double duration) {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = duration;
  request.images = false;
  return simulation::SimulatedSource(simulation::optionsOf(request));
}

/// A session of a simulated sinusoid, tips without pictures, whose pipeline a live identification hears.
struct Session {
  explicit Session(double duration)
      : source(sinusoid(duration)), pipeline(tracking::makePipeline(source.info())) {
    live.begin(source.info().robot, source.info().title);
  }
  /// On to `until` [s]. Requested runs are made at once, by a clock of a tenth of the session's
  /// speed; returns how many.
  int runTo(double until, bool runs = true) {
    if (live.sink()) live.sink()->begin(pipeline);
    int made = 0;
    tracking::Sample sample;
    for (double t = 0.0; t < until && source.next(sample);) {
      const tracking::Snapshot& snapshot = pipeline.step(sample);
      t = snapshot.t;
      if (live.sink()) live.sink()->take(sample, snapshot);
      if (runs && snapshot.camera_updated) made += run(0.1 * t);
    }
    return made;
  }
  void feedTo(double until) { runTo(until, false); }
  int run(double now) {
    const auto request = live.next(now);
    if (!request) return 0;
    EXPECT_FALSE(live.next(now)) << "never two at once";
    LiveReport report = runLive(*request, progress);
    report.seconds = 0.0;  // so that the number of runs is that of the clock alone
    EXPECT_TRUE(live.take(report, now));
    return 1;
  }

  simulation::SimulatedSource source;
  tracking::TrackingPipeline pipeline;
  LiveIdentification live;
  base::Progress progress;
};

TEST(Live, FindsThePulleyOfTheSimulatedRobotWithinItsStatedInterval) {
  Session session(40.0);
  session.live.start(session.source.info().robot, "r_l1");
  EXPECT_FALSE(session.live.acceptable());
  const int runs = session.runTo(40.0);
  EXPECT_GE(runs, 6) << "live";
  session.live.stop();
  EXPECT_EQ(session.run(1e6), 1) << "a last one over everything";
  ASSERT_TRUE(session.live.acceptable());
  const Estimate found = session.live.shown().estimates[0];
  EXPECT_LT(found.low(), 0.059);
  EXPECT_GT(found.high(), 0.059);
  EXPECT_LT(found.sigma, 0.002);
  const LiveRow row = session.live.rows()[0];
  EXPECT_EQ(row.name, "r_l1");
  EXPECT_EQ(row.unit, "mm");
  EXPECT_NEAR(std::stod(row.value), 59.0, 0.2);
  EXPECT_EQ(row.change, "−6.5 %");
  EXPECT_EQ(row.share, 1.0);
  EXPECT_NEAR(session.live.trace().front().t, 0.0, 1e-9) << "from the recording's beginning";

  const robot::Description identified = session.live.accept();
  EXPECT_EQ(identified.drives[0].link_radius, found.value());
  EXPECT_EQ(session.live.phase(), LivePhase::kAccepted);
  ASSERT_EQ(session.live.changes().size(), 1U);
  EXPECT_EQ(session.live.changes()[0].key, "drives[0].link_radius");
  const robot::Description saved = robot::parseDescription(session.live.robotFile(), "saved");
  EXPECT_EQ(saved.drives[0].link_radius, identified.drives[0].link_radius);
  EXPECT_NE(session.live.robotFile().find("# Identified by the dual UKF over 40 s"), std::string::npos)
      << session.live.robotFile().substr(0, 200);
  EXPECT_EQ(session.live.revert().drives[0].link_radius, session.source.info().robot.drives[0].link_radius);
  EXPECT_EQ(session.live.phase(), LivePhase::kIdle);
}

TEST(Live, ARunThatWasOvertakenIsDroppedAndTheLastOneCoversEverything) {
  Session session(12.0);
  session.live.start(session.source.info().robot, "r_l1");
  session.runTo(8.0);
  const double before = session.live.shown().recorded;
  session.feedTo(12.0);
  const auto request = session.live.next(1e6);
  ASSERT_TRUE(request);
  const LiveReport late = runLive(*request, session.progress);
  session.live.stop();
  EXPECT_FALSE(session.live.take(late, 1e6));
  EXPECT_EQ(session.live.shown().recorded, before);
  const auto last = session.live.next(1e6);
  ASSERT_TRUE(last) << "over everything that was collected";
  EXPECT_TRUE(session.live.take(runLive(*last, session.progress), 1e6));
  EXPECT_GT(session.live.shown().recorded, before);
  EXPECT_FALSE(session.live.next(2e6)) << "nothing new, nothing to do";
  EXPECT_FALSE(session.live.sink());
}

TEST(Live, SaysHowOldItsValuesAreOnlyWhereTheyLagBehindTheRecording) {
  Session session(12.0);
  session.live.start(session.source.info().robot, "r_l1");
  session.feedTo(6.0);
  ASSERT_EQ(session.run(100.0), 1);
  EXPECT_EQ(session.live.words().find("first"), std::string::npos) << session.live.words();
  session.feedTo(6.0 + LiveIdentification::kLag + 1.0);
  EXPECT_NE(session.live.words().find("computed from the first 6 s only. The computation is slower than"),
            std::string::npos)
      << session.live.words();
  session.live.stop();
  EXPECT_NE(
      session.live.words().find("from the first 6 s only. The computation from all of them is under way"),
      std::string::npos)
      << session.live.words();
  ASSERT_EQ(session.run(200.0), 1);
  EXPECT_EQ(session.live.words(),
            "Stopped. The values are computed from 9 s by the dual UKF; Refine computes more precise ones. "
            "Accept takes r_l1.");
}

TEST(Live, TheNextRunWaitsAsLongAsTheLastOneTook) {
  Session session(10.0);
  session.live.start(session.source.info().robot, "r_l1");
  session.feedTo(1.9);
  EXPECT_FALSE(session.live.next(99.0)) << "too little";
  session.feedTo(3.0);
  const auto request = session.live.next(100.0);
  ASSERT_TRUE(request);
  LiveReport report = runLive(*request, session.progress);
  report.seconds = 7.0;
  ASSERT_TRUE(session.live.take(report, 100.0));
  session.feedTo(6.0);
  EXPECT_FALSE(session.live.next(106.9));
  EXPECT_TRUE(session.live.next(107.1));
}

TEST(Live, HoldsWhatACollectorOfTheWholeWouldHold) {
  auto source = sinusoid(6.0);
  auto pipeline = tracking::makePipeline(source.info());
  LiveRecording live("live");
  live.begin(pipeline);
  DataCollector whole(pipeline, "whole");
  tracking::Sample sample;
  for (int i = 0; source.next(sample); ++i) {
    const tracking::Snapshot& snapshot = pipeline.step(sample);
    whole.add(sample, snapshot);
    live.take(sample, snapshot);
    if (i % 1700 == 0) live.data();
  }
  const IdentificationData wanted = whole.finish(), held = live.data();
  EXPECT_EQ(held.motors.t, wanted.motors.t);
  EXPECT_EQ(held.motors.position, wanted.motors.position);
  ASSERT_EQ(held.cameras.size(), wanted.cameras.size());
  EXPECT_GT(held.cameras.size(), 80U);
  for (std::size_t i = 0; i < held.cameras.size(); ++i) {
    EXPECT_EQ(held.cameras[i].t, wanted.cameras[i].t);
    EXPECT_EQ(held.cameras[i].tip, wanted.cameras[i].tip);
    EXPECT_EQ(held.cameras[i].tip_covariance, wanted.cameras[i].tip_covariance);
    EXPECT_EQ(held.cameras[i].open, wanted.cameras[i].open);
  }
}

TEST(Live, GoesOnAfterAPauseAndBeginsAnewWhereTheOldIsWorthless) {
  auto source = sinusoid(6.0);
  auto pipeline = tracking::makePipeline(source.info());
  LiveRecording live("live");
  EXPECT_EQ(live.data().motors.size(), 0U);
  live.begin(pipeline);
  tracking::Sample sample;
  const auto feed = [&](int samples) {
    for (int i = 0; i < samples && source.next(sample); ++i) live.take(sample, pipeline.step(sample));
  };
  feed(2000);
  const auto motors = live.extent().motors;
  EXPECT_EQ(live.data().motors.size(), motors);
  live.begin(pipeline);
  EXPECT_EQ(live.extent().motors, motors) << "the same robot and registration: it goes on";
  EXPECT_EQ(live.extent().restarts, 0U);
  feed(2000);
  pipeline.setRegistration(Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.2, 0.3)));
  live.begin(pipeline);
  EXPECT_EQ(live.extent().motors, 0U);
  EXPECT_EQ(live.extent().restarts, 1U);
  feed(2000);
  EXPECT_EQ(live.data().motors.size(), live.extent().motors);

  tracking::Snapshot back = pipeline.snapshot();
  back.t -= 1.0;
  back.motor_updated = true;
  back.camera_updated = false;
  live.take({}, back);
  EXPECT_EQ(live.extent().motors, 1U) << "the motors' clock was set back";
  EXPECT_EQ(live.extent().restarts, 2U);
}

TEST(Live, KeepsNoMoreThanItsLongest) {
  auto source = sinusoid(6.0);
  auto pipeline = tracking::makePipeline(source.info());
  LiveRecording live("live", 2.0);
  live.begin(pipeline);
  tracking::Sample sample;
  while (source.next(sample)) live.take(sample, pipeline.step(sample));
  EXPECT_TRUE(live.extent().full);
  EXPECT_NEAR(live.data().duration(), 2.0, 2e-3);
}

TEST(Live, SaysWhyNothingComes) {
  LiveExtent extent;
  EXPECT_NE(wordsOf(extent).find("Waiting"), std::string::npos);
  extent.motors = 5000;
  extent.seconds = 5.0;
  EXPECT_NE(wordsOf(extent).find("no camera"), std::string::npos);
  extent.cameras = 70;
  EXPECT_NE(wordsOf(extent).find("do not detect"), std::string::npos);
  extent.registered = false;
  EXPECT_NE(wordsOf(extent).find("not registered"), std::string::npos);
  extent = {.seconds = 12.4, .motors = 12400, .cameras = 180, .observations = 160};
  EXPECT_EQ(wordsOf(extent), "12 s collected; the tip was observed 160 times.");
}

TEST(Live, WhatCannotBeSeenIsWeakAndStaysAsItIs) {
  Session session(8.0);
  const robot::Description file = session.source.info().robot;
  session.live.start(file, "r_l1,b_e1");
  session.runTo(8.0);
  const auto rows = session.live.rows();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_TRUE(rows[0].seen);
  EXPECT_FALSE(rows[1].seen);
  EXPECT_EQ(rows[1].value, "not observable");
  EXPECT_NE(rows[1].words.find("Move faster"), std::string::npos) << rows[1].words;
  EXPECT_EQ(session.live.summary().find("b_e1"), std::string::npos);
  EXPECT_EQ(session.live.accept().drives[0].cable_damping, file.drives[0].cable_damping);
}

TEST(Live, ASecondOneStandsUponTheFirstAndIsComparedWithTheFile) {
  Session session(14.0);
  robot::Description in_use = session.source.info().robot;
  in_use.drives[0].link_radius = 0.059;
  session.live.start(in_use, "r_l1");
  session.runTo(14.0);
  ASSERT_TRUE(session.live.acceptable());
  EXPECT_TRUE(session.live.rows()[0].change.starts_with("−6.")) << "of 63.095 mm, not of 59";
}

TEST(Live, RefinesByTheBatchMethodOnDemand) {
  Session session(15.0);
  session.live.start(session.source.info().robot, "r_l1");
  session.runTo(15.0);
  const auto trace = session.live.trace().size();
  session.live.refine();
  EXPECT_EQ(session.live.phase(), LivePhase::kStopped);
  auto request = session.live.next(1e6);
  ASSERT_TRUE(request);
  EXPECT_EQ(request->method, LiveMethod::kBatch);
  EXPECT_EQ(request->start.size(), 1U);
  session.live.cancelRefinement();
  EXPECT_FALSE(session.live.take(runLive(*request, session.progress), 1e6)) << "cancelled";
  EXPECT_FALSE(session.live.refined());
  session.live.refine();
  request = session.live.next(2e6);
  ASSERT_TRUE(request);
  EXPECT_TRUE(session.live.take(runLive(*request, session.progress), 2e6));
  EXPECT_TRUE(session.live.refined());
  EXPECT_NEAR(session.live.shown().estimates[0].value(), 0.059, 0.003 * 0.059);
  EXPECT_EQ(session.live.trace().size(), trace) << "the dual UKF's stays";
  EXPECT_NE(session.live.words().find("from 15 s by the batch method"), std::string::npos)
      << session.live.words();
}

TEST(Live, ACancelledRunEndsBeforeItsRecordingDoes) {
  Session session(20.0);
  session.live.start(session.source.info().robot, "r_l1,k_e,b_e,f_c");
  session.feedTo(20.0);
  for (const bool batch : {false, true}) {
    if (batch) session.live.refine();
    const auto request = session.live.next(1e6);
    ASSERT_TRUE(request);
    base::Progress progress;
    progress.cancel();
    const LiveReport report = runLive(*request, progress);
    EXPECT_TRUE(report.cancelled);
    EXPECT_TRUE(report.estimates.empty());
    EXPECT_LT(progress.fraction(), 0.05);
    EXPECT_FALSE(session.live.take(report, 1e6));
    EXPECT_FALSE(session.live.acceptable());
  }
}

TEST(Live, RefusesANonsenseChoiceAndChangesNothing) {
  Session session(4.0);
  EXPECT_THROW(session.live.start(session.source.info().robot, "r_l9"), base::InputError);
  EXPECT_THROW(session.live.start(session.source.info().robot, ""), base::InputError);
  EXPECT_EQ(session.live.phase(), LivePhase::kIdle);
}

TEST(LiveText, HasAsManyDecimalsAsTheSigmaHasMeaning) {
  Estimate estimate;
  estimate.parameter = {Quantity::kStiffness, 1, 88000.0, 1.0, 5.0, 0.05};
  estimate.log = std::log(0.7);
  estimate.sigma = 0.02;
  estimate.seen = true;
  const LiveRow row = rowOf(estimate, nullptr, -30.0);
  EXPECT_EQ(row.value, "61.6");
  EXPECT_EQ(row.sigma, "±1.2");
  EXPECT_EQ(row.unit, "kN");
  EXPECT_EQ(row.change, "−30.0 %");
  EXPECT_TRUE(row.settled) << "finer than its goal";
  estimate.sigma = std::sqrt(1.0 * 0.05);
  EXPECT_NEAR(rowOf(estimate, nullptr, 0.0).share, 0.5, 1e-12) << "half of the way in ln sigma";
}

}  // namespace
}  // namespace capstan::identification
