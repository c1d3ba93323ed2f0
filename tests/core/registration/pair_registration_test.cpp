#include "core/registration/pair_registration.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "core/vision/registration.h"

namespace capstan::registration {
namespace {

constexpr double kChiSquare6At95 = 12.592;

struct Set {
  std::vector<Eigen::Vector3d> camera, base;
  Eigen::Isometry3d truth;
};

Set generated(unsigned seed, int count, double noise, int outliers) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  Set set;
  set.truth = Eigen::Translation3d(0.2 * vector()) *
              Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d camera = Eigen::Vector3d(0.0, 0.0, 0.3) + 0.05 * vector();
    set.camera.push_back(camera);
    set.base.push_back(set.truth * camera + noise * vector());
    if (i < outliers) set.base.back() += 0.03 * vector().normalized() * (1.0 + std::abs(normal(random)));
  }
  return set;
}

TEST(PairRegistration, IsTheClosedFormWithoutOutliers) {
  const Set set = generated(5, 50, 0.0005, 0);
  const auto found = registerPairs(set.camera, set.base);
  const auto closed = vision::registerRigid(set.camera, set.base);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(std::ranges::count(found.value().used, true), 50);
  EXPECT_LT((found.value().base_from_camera.matrix() - closed.value().base_from_camera.matrix()).norm(),
            1e-9);
}

TEST(PairRegistration, TruthIsWithinTheStatedIntervalAmongOutliers) {
  int inside = 0, outliers_used = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Set set = generated(1000 + seed, 50, 0.0005, 10);
    const auto found = registerPairs(set.camera, set.base);
    ASSERT_TRUE(found.has_value()) << seed;
    const auto& result = found.value();
    const Eigen::AngleAxisd turn(set.truth.rotation() * result.base_from_camera.rotation().transpose());
    Eigen::Matrix<double, 6, 1> error;
    error << turn.angle() * turn.axis(), set.truth.translation() - result.base_from_camera.translation();
    inside += error.dot(result.covariance.inverse() * error) <= kChiSquare6At95;
    outliers_used += static_cast<int>(std::count(result.used.begin(), result.used.begin() + 10, true));
  }
  std::printf("inside the 95 %% region: %d of 200; outliers used: %d of 2000\n", inside, outliers_used);
  EXPECT_GE(inside, 180);
  EXPECT_EQ(outliers_used, 0);
}

PairFault faultOf(const Set& set) {
  const auto found = registerPairs(set.camera, set.base);
  EXPECT_FALSE(found.has_value());
  return found.has_value() ? PairFault::kTooFewPairs : found.error().fault;
}

TEST(PairRegistration, RefusesWhatIsNotDetermined) {
  EXPECT_EQ(faultOf(generated(1, 3, 0.0005, 0)), PairFault::kTooFewPairs);
  Set line = generated(2, 20, 0.0, 0);
  for (std::size_t i = 0; i < line.camera.size(); ++i) {
    line.camera[i] = Eigen::Vector3d(0.01 * static_cast<double>(i), 0.0, 0.3);
    line.base[i] = line.truth * line.camera[i];
  }
  EXPECT_EQ(faultOf(line), PairFault::kCollinear);
  Set mirrored = generated(3, 20, 0.0005, 0);
  for (auto& point : mirrored.camera) point.x() = -point.x();
  EXPECT_EQ(faultOf(mirrored), PairFault::kMirrored);
  Set millimetres = generated(4, 20, 0.0005, 0);
  for (auto& point : millimetres.camera) point *= 1000.0;
  EXPECT_EQ(faultOf(millimetres), PairFault::kScale);
  Set unrelated = generated(6, 20, 0.0005, 0);
  std::ranges::reverse(unrelated.base);
  EXPECT_EQ(faultOf(unrelated), PairFault::kNoAgreement);
}

}  // namespace
}  // namespace capstan::registration
