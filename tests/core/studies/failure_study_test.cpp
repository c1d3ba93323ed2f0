// Studies of failed motor encoders and late cameras, small: what is averaged, found, corrected, stopped.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/studies/latency_study.h"
#include "core/studies/motor_failure_study.h"

namespace capstan::studies {
namespace {

namespace fs = std::filesystem;
using tracking::MotorFault;

MotorFailureStudyOptions shortFailure() {
  MotorFailureStudyOptions options;
  options.duration = 5.0;
  options.warm_up = 2.0;
  options.speeds = {1.0};
  options.occlusions = {40.0};
  options.seeds = 1;
  return options;
}

MotorFailureStudy studyOf(const MotorFailureStudyOptions& options) {
  base::Progress progress;
  return runMotorFailureStudy(options, progress);
}

TEST(MotorFailureStudy, ALostEncoderCostsItsJointAndIsKnownAtOnce) {
  const MotorFailureStudyOptions options = shortFailure();
  const MotorFailureStudy study = studyOf(options);
  ASSERT_EQ(study.cells.size(), 4U);
  for (int motor = 0; motor < 4; ++motor) {
    const MotorFailureResult& cell = study.cells[static_cast<std::size_t>(motor)];
    EXPECT_EQ(cell.motor, motor);
    EXPECT_EQ(cell.normal_rms, study.cells[0].normal_rms) << "one trial, tracked side by side";
    const Endurance &own = cell.endurance(NormalError::kOwn),
                    &nominal = cell.endurance(NormalError::kNominal);
    EXPECT_GT(cell.normal(NormalError::kNominal)(0), 3.0 * cell.normal(NormalError::kOwn)(0))
        << "the true radius is 6.5 % off the nominal one";
    EXPECT_LT(cell.ratio(NormalError::kNominal), cell.ratio(NormalError::kOwn));
    EXPECT_GE(nominal.held, own.held);
    EXPECT_GE(nominal.share, own.share);
    EXPECT_GE(nominal.whole, own.whole);
    EXPECT_NEAR(cell.found, 0.1, 3e-3) << "TrackingOptions::lost_after";
    for (const Endurance& endurance : cell.within) {
      EXPECT_GT(endurance.held, 0.0);
      EXPECT_LE(endurance.held, options.duration + 0.3) << "a trial ends with its last whole frame";
      EXPECT_GE(endurance.share, 0.0);
      EXPECT_LE(endurance.share, 1.0);
      EXPECT_EQ(endurance.share == 1.0, endurance.whole == 1);
    }
    EXPECT_GT(cell.ratio(NormalError::kOwn), 1.0) << "the camera alone, often occluded, is worse";
    EXPECT_GT(cell.nees, 0.0);
    for (int joint = 0; joint < 3; ++joint)
      if (motor == 3 || joint == motor) {
        EXPECT_GT(cell.failed_rms(joint), cell.normal(NormalError::kOwn)(joint)) << motor << joint;
      }
  }
  EXPECT_LT(study.cells[2].failed_rms(0), 1.5 * study.cells[2].normal(NormalError::kOwn)(0))
      << "motor 1 holds joint 1";
}

TEST(MotorFailureStudy, AFrozenCountTakesLongerToBeFound) {
  MotorFailureStudyOptions options = shortFailure();
  options.fault = MotorFault::kFrozen;
  options.occlusions = {0.0};
  const MotorFailureStudy study = studyOf(options);
  int found = 0;
  for (const MotorFailureResult& cell : study.cells) {
    if (std::isnan(cell.found)) continue;  // the joint rested
    EXPECT_GT(cell.found, 0.1);
    ++found;
  }
  EXPECT_GE(found, 2);
}

/// Medians and roots of mean squares over seeds, from the seeds studied one by one; threads change nothing.
TEST(MotorFailureStudy, SeedsAreTakenTogether) {
  MotorFailureStudyOptions options = shortFailure();
  options.duration = 3.0;
  const MotorFailureStudy first = studyOf(options);
  options.seed = 2;
  const MotorFailureStudy second = studyOf(options);
  options.seed = 1;
  options.seeds = 2;
  options.threads = 2;
  const MotorFailureStudy both = studyOf(options);
  ASSERT_EQ(both.cells.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const MotorFailureResult &a = first.cells[i], &b = second.cells[i], &all = both.cells[i];
    for (std::size_t n = 0; n < kNormalErrors; ++n) {
      EXPECT_DOUBLE_EQ(all.within[n].held, 0.5 * (a.within[n].held + b.within[n].held));
      EXPECT_DOUBLE_EQ(all.within[n].share, 0.5 * (a.within[n].share + b.within[n].share));
      EXPECT_EQ(all.within[n].whole, a.within[n].whole + b.within[n].whole);
    }
    for (int joint = 0; joint < 3; ++joint)
      EXPECT_NEAR(all.failed_rms(joint),
                  std::sqrt(0.5 * (std::pow(a.failed_rms(joint), 2) + std::pow(b.failed_rms(joint), 2))),
                  1e-12);
  }
}

TEST(MotorFailureStudy, TablesHoldEveryCell) {
  MotorFailureStudyOptions options = shortFailure();
  options.occlusions = {0.0, 20.0};
  MotorFailureStudy study;
  for (int motor = 0; motor < 4; ++motor)
    for (const double occlusion : options.occlusions) {
      MotorFailureResult cell;
      cell.motor = motor;
      cell.occlusion = occlusion;
      cell.normal_rms = {Eigen::Vector3d(0.01, 0.02, 1e-3), Eigen::Vector3d(0.03, 0.02, 2e-3)};
      cell.failed_rms = Eigen::Vector3d(0.03, 0.02, 4e-3);
      cell.within = {Endurance{1.25, 0.5, occlusion == 0.0 ? 1 : 0}, Endurance{3.5, 0.75, 0}};
      study.cells.push_back(cell);
    }
  EXPECT_DOUBLE_EQ(study.cells[0].ratio(NormalError::kOwn), 3.0);
  EXPECT_DOUBLE_EQ(study.cells[6].ratio(NormalError::kOwn), 4.0) << "all: the worst joint";
  const base::Table map = mapOf(study, options, NormalError::kOwn);
  ASSERT_EQ(map.rows.size(), 4U);
  ASSERT_EQ(map.columns.size(), 4U);
  EXPECT_EQ(map.rows[0][2].text, "whole trial, ×3.0, 1.72°");
  EXPECT_EQ(map.rows[2][3].text, "1.2 s, ×4.0, 4.0 mm");
  EXPECT_EQ(mapOf(study, options, NormalError::kNominal).rows[2][3].text, "3.5 s, ×2.0, 4.0 mm");
  const base::Table details = detailsOf(study, options);
  ASSERT_EQ(details.rows.size(), 8U);
  for (const auto& row : details.rows) EXPECT_EQ(row.size(), details.columns.size());
}

TEST(MotorFailureStudy, AStudyGoesOnWhereItWasStopped) {
  const fs::path folder = fs::path(testing::TempDir()) / "capstan_failures";
  fs::remove_all(folder);
  MotorFailureStudyOptions options = shortFailure();
  options.duration = 3.0;
  options.out = folder;
  const MotorFailureStudy first = studyOf(options);
  const fs::path file = folder / "lost-speed-1-40-occluded-seed-1.json";
  ASSERT_TRUE(fs::exists(file));
  const auto written = fs::last_write_time(file);
  options.seeds = 2;
  (void)studyOf(options);
  options.seeds = 1;
  const MotorFailureStudy again = studyOf(options);
  EXPECT_EQ(fs::last_write_time(file), written) << "not run again";
  EXPECT_TRUE(again.notices.empty());
  EXPECT_EQ(base::csvOf(detailsOf(again, options)), base::csvOf(detailsOf(first, options)));
  options.true_radii = false;
  EXPECT_EQ(studyOf(options).notices.size(), 1U) << "another question";
  fs::remove_all(folder);
}

LatencyStudyOptions shortLatency() {
  LatencyStudyOptions options;
  options.delays = {0.03};
  options.duration = 25.0;
  options.seeds = 1;
  options.parameters = "r_l";
  return options;
}

TEST(LatencyStudy, ALateStampIsEstimatedAndCorrected) {
  const fs::path folder = fs::path(testing::TempDir()) / "capstan_latency";
  fs::remove_all(folder);
  LatencyStudyOptions options = shortLatency();
  options.out = folder;
  base::Progress progress;
  const LatencyStudy study = runLatencyStudy(options, progress);
  ASSERT_EQ(study.trials.size(), 1U);
  const LatencyTrial& trial = study.trials[0];
  EXPECT_EQ(trial.truth, 0.03);
  for (const std::size_t method : {0U, 1U}) {
    EXPECT_GT(trial.sigma[method], 0.0);
    EXPECT_LT(trial.sigma[method], 0.2 * options.prior_sigma);
    EXPECT_NEAR(trial.delay[method], 0.03, 0.002) << method << ": one pass is further off";
  }
  const auto& [stamped, corrected, exact] = trial.rms[1];
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_LT(corrected(joint), stamped(joint)) << joint;
    EXPECT_NEAR(corrected(joint), exact(joint), 0.25 * (stamped(joint) - exact(joint))) << joint;
  }
  const base::Table estimates = estimatesOf(study, options), gain = gainOf(study, options);
  ASSERT_EQ(estimates.rows.size(), 1U);
  EXPECT_DOUBLE_EQ(estimates.rows[0][0].number, 30.0);
  EXPECT_DOUBLE_EQ(estimates.rows[0][1].number, 1e3 * trial.delay[0]);
  EXPECT_EQ(estimates.rows[0][6].text, trial.covered(experiments::Method::kBatch) ? "1 of 1" : "0 of 1");
  ASSERT_EQ(gain.rows.size(), 3U);
  for (const auto& row : gain.rows) EXPECT_EQ(row.size(), gain.columns.size());
  const auto written = fs::last_write_time(folder / "stamps-30-ms-late-seed-1.json");
  const LatencyStudy again = runLatencyStudy(options, progress);
  EXPECT_EQ(fs::last_write_time(folder / "stamps-30-ms-late-seed-1.json"), written) << "not run again";
  EXPECT_EQ(base::csvOf(estimatesOf(again, options)), base::csvOf(estimates));
  EXPECT_EQ(base::csvOf(gainOf(again, options)), base::csvOf(gain));
  fs::remove_all(folder);
}

TEST(LatencyStudy, CoverageIsOfTheNormalInterval) {
  LatencyTrial trial;
  trial.truth = 0.02;
  trial.delay = {0.0219, 0.0221};
  trial.sigma = {0.001, 0.001};
  EXPECT_TRUE(trial.covered(experiments::Method::kDualUkf));
  EXPECT_FALSE(trial.covered(experiments::Method::kBatch)) << "1.96 sigma, not 2.1";
}

TEST(FailureStudies, StopWhenCancelled) {
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(runMotorFailureStudy(shortFailure(), progress).cancelled);
  const LatencyStudy latency = runLatencyStudy(shortLatency(), progress);
  EXPECT_TRUE(latency.cancelled);
  EXPECT_TRUE(latency.trials.empty());
}

}  // namespace
}  // namespace capstan::studies
