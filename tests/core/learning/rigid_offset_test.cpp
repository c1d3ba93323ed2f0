// Rigid offsets of pairs that were made from a known one.
#include "core/learning/poses/rigid_offset.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/learning/poses/rotation_vector.h"

namespace capstan::learning {
namespace {

Eigen::Isometry3d pose(const Eigen::Vector3d& position, const Eigen::Vector3d& rotation_vector) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.linear() = turnBy(rotation_vector).toRotationMatrix();
  t.translation() = position;
  return t;
}

Eigen::Vector3d draw(base::Random& random, double sigma) {
  return {random.normal(0.0, sigma), random.normal(0.0, sigma), random.normal(0.0, sigma)};
}

const Eigen::Isometry3d kOffset = pose({0.02, -0.015, 0.008}, {0.2, -0.1, 0.3});

std::vector<PosePair> pairs(std::size_t n, double noise, std::uint64_t seed = 1) {
  base::Random random(seed, "pose pairs");
  std::vector<PosePair> made;
  while (made.size() < n) {
    const Eigen::Isometry3d observed = pose(draw(random, 0.05), draw(random, 1.0));
    made.push_back({observed, kOffset * observed * pose(draw(random, noise), draw(random, noise / kLever))});
  }
  return made;
}

double apart(const Eigen::Isometry3d& a) { return std::sqrt(squaredDistance(a, kOffset, kLever)); }

TEST(RigidOffset, isExactWithoutNoise) {
  EXPECT_LT(apart(rigidOffset(pairs(1, 0.0))), 1e-12) << "one pair is enough";
  EXPECT_LT(apart(rigidOffset(pairs(20, 0.0))), 1e-12);
  EXPECT_TRUE(rigidOffset({}).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(RigidOffset, isARotationAndNoMirror) {
  std::vector<PosePair> mirrored = pairs(20, 0.0);
  for (PosePair& pair : mirrored) pair.commanded.translation().x() *= -1.0;
  EXPECT_NEAR(rigidOffset(mirrored, 1e-4).linear().determinant(), 1.0, 1e-12);
}

/// At its own least: no small change makes the sum of squares smaller.
TEST(RigidOffset, leavesLeast) {
  const std::vector<PosePair> some = pairs(30, 0.003);
  const auto sum = [&](const Eigen::Isometry3d& g) {
    double total = 0.0;
    for (const PosePair& pair : some) {
      const Eigen::Isometry3d moved = g * pair.observed;
      total += (moved.translation() - pair.commanded.translation()).squaredNorm() / (kLever * kLever) +
               (moved.linear() - pair.commanded.linear()).squaredNorm();
    }
    return total;
  };
  const Eigen::Isometry3d best = rigidOffset(some);
  base::Random random(3, "changes");
  for (int k = 0; k < 200; ++k)
    EXPECT_GE(sum(pose(draw(random, 1e-4), draw(random, 1e-3)) * best), sum(best) * (1.0 - 1e-12));
}

TEST(LeastMedian, standsFortyPercentWrong) {
  std::vector<PosePair> some = pairs(200, 0.0005);
  base::Random random(5, "wrong ones");
  for (std::size_t k = 0; k < some.size(); ++k)
    if (k % 5 < 2) some[k].observed = pose(draw(random, 0.1), draw(random, 1.0));
  const MedianReport report = leastMedianOffset(some);
  EXPECT_LT(apart(report.offset), 0.0005);
  int wrong_kept = 0, right_kept = 0;
  for (std::size_t k = 0; k < some.size(); ++k) (k % 5 < 2 ? wrong_kept : right_kept) += report.belongs[k];
  EXPECT_EQ(wrong_kept, 0);
  EXPECT_GE(right_kept, 110);
  EXPECT_GT(apart(rigidOffset(some)), 0.005) << "least squares does not stand it";
}

TEST(LeastMedian, isTheSameForASeed) {
  const std::vector<PosePair> some = pairs(50, 0.002);
  EXPECT_TRUE(leastMedianOffset(some).offset.isApprox(leastMedianOffset(some).offset, 0.0));
}

TEST(LeastMedian, keepsAllOfVeryFew) {
  const MedianReport report = leastMedianOffset(pairs(2, 0.0));
  EXPECT_EQ(report.belongs, std::vector<bool>(2, true));
  EXPECT_LT(apart(report.offset), 1e-12);
}

}  // namespace
}  // namespace capstan::learning
