#include "core/studies/one_camera_study.h"

#include <gtest/gtest.h>

namespace capstan::studies {
namespace {

// With wrong constants and one camera blocked nearly always, the ray teaches the filter the transmission
// error; with the right constants there is nothing to gain and nothing may be lost.
TEST(OneCameraStudy, TheRayTeachesWhatTheHardSwitchCannot) {
  OneCameraStudyOptions options;
  options.shares = {90.0};
  options.duration = 40.0;
  base::Progress progress;
  const OneCameraStudy study = runOneCameraStudy(options, progress);
  ASSERT_EQ(study.comparisons.size(), 4u);
  for (const OneCameraComparison& one : study.comparisons) {
    const OneCameraResult &hard = one.hard_switch, &ray = one.ray;
    EXPECT_GT(ray.ray_share, 0.95) << one.robot << one.filter;
    EXPECT_EQ(hard.ray_share, 0.0);
    if (one.robot == "true radii") {
      EXPECT_LT(ray.ray_nis, 1.5) << one.filter;
      EXPECT_LT((ray.all - hard.all).cwiseQuotient(hard.all).maxCoeff(), 0.1) << one.filter;
    } else if (one.filter == "augmented") {
      EXPECT_LT(ray.blocked.x(), 0.9 * hard.blocked.x());
    }
  }
}

}  // namespace
}  // namespace capstan::studies
