#include "core/studies/noise_study.h"

#include <gtest/gtest.h>

#include "core/studies/cramer_rao_tables.h"

namespace capstan::studies {
namespace {

CramerRaoOptions few() {
  CramerRaoOptions options;
  options.runs = 12;
  options.duration = 2.5;
  options.settling = 0.5;
  return options;
}

TEST(CramerRaoStudy, DoesNotDependOnTheThreads) {
  CramerRaoOptions one = few(), two = few();
  one.threads = 1;
  two.threads = 2;
  base::Progress progress;
  const CramerRaoStudy a = studyCramerRao(one, progress), b = studyCramerRao(two, progress);
  EXPECT_EQ(a.bound, b.bound);
  EXPECT_EQ(a.rms[0], b.rms[0]);
  EXPECT_EQ(a.rms[1], b.rms[1]);
  EXPECT_EQ(a.interval[0][1].low, b.interval[0][1].low);
}

/// Memory is that of a segment of time; where one ends changes nothing but the last bits of the bound's sum.
TEST(CramerRaoStudy, DoesNotDependOnTheStretchesOfTime) {
  CramerRaoOptions whole = few(), parts = few();
  whole.segment = whole.duration;
  parts.segment = 0.3;
  base::Progress progress;
  const CramerRaoStudy a = studyCramerRao(whole, progress), b = studyCramerRao(parts, progress);
  EXPECT_LT((a.bound - b.bound).cwiseQuotient(a.bound).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(a.rms[0], b.rms[0]);
  EXPECT_EQ(a.rms[1], b.rms[1]);
  EXPECT_EQ(a.nees, b.nees);
  EXPECT_EQ(a.updates, b.updates);
}

/// Without Coulomb friction the model is almost linear, and a UKF then reaches the bound, which is no less
/// than what any estimator can do.
TEST(CramerRaoStudy, WithoutFrictionTheFilterReachesTheBound) {
  CramerRaoOptions options = few();
  options.runs = 24;
  options.coulomb_friction = false;
  base::Progress progress;
  const CramerRaoStudy study = studyCramerRao(options, progress);
  for (int joint = 0; joint < 3; ++joint) {
    const stats::Interval& interval = study.interval[0][static_cast<std::size_t>(joint)];
    EXPECT_LT(interval.low, 1.05) << joint;
    EXPECT_GT(interval.high, 0.95) << joint;
    EXPECT_LT(study.bound(joint), study.camera(joint)) << joint;
  }
  EXPECT_EQ(study.updates, 37u);
}

TEST(CramerRaoStudy, StopsWhenCancelled) {
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(studyCramerRao(few(), progress).cancelled);
}

TEST(CramerRaoStudy, TheTableJudgesByTheGoal) {
  CramerRaoStudy study;
  study.bound = study.camera = Eigen::Vector3d(0.01, 0.02, 1e-3);
  study.rms = {1.05 * study.bound, 1.2 * study.bound};
  study.ratio = {Eigen::Vector3d::Constant(1.05), Eigen::Vector3d::Constant(1.2)};
  const base::Table table = closenessOf(study, few());
  ASSERT_EQ(table.rows.size(), 6u);
  EXPECT_EQ(table.rows[0].back().text, "met");
  EXPECT_EQ(table.rows[1].back().text, "not met");
  EXPECT_NEAR(table.rows[2][3].number, 1.1459156, 1e-6) << "0.02 rad in degrees";
  EXPECT_NEAR(table.rows[5][4].number, 1.2, 1e-12) << "1.2 mm";
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
}

TEST(NoiseStudy, VariantsSeeTheSameSamples) {
  NoiseStudyOptions options;
  options.duration = 3.0;
  options.trials = 1;
  options.images = false;
  base::Progress progress;
  const NoiseStudy study = studyNoise(options, progress);
  ASSERT_EQ(study.variants.size(), 8u);
  for (std::size_t i = 0; i < study.variants.size(); ++i) {
    const NoiseVariant &variant = study.variants[i], &constant = study.variants[study.constantBeside(i)];
    EXPECT_EQ(constant.name, "constant");
    EXPECT_EQ(constant.true_radius, variant.true_radius);
    EXPECT_EQ(constant.kinematic, variant.kinematic);
    EXPECT_GT(variant.ukf.minCoeff(), 0.0);
    if (variant.name == "no camera") {
      EXPECT_LT(variant.nis, 1e-3);
    }
  }
  EXPECT_GT(study.variants[4].kinematic(0), 10.0 * study.variants[0].kinematic(0)) << "the nominal pulley";
}

}  // namespace
}  // namespace capstan::studies
