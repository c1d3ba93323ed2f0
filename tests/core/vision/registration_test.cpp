#include "core/vision/registration.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"

namespace capstan::vision {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d normalVector(base::Random& random, const Eigen::Vector3d& sigma) {
  return {random.normal(0, sigma.x()), random.normal(0, sigma.y()), random.normal(0, sigma.z())};
}

Eigen::Isometry3d somewhere(base::Random& random) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(random.uniform(0.0, 3.1), normalVector(random, Eigen::Vector3d::Ones()).normalized())
          .toRotationMatrix();
  pose.translation() = normalVector(random, Eigen::Vector3d::Constant(0.5));
  return pose;
}

TEST(RegisterAtHardStop, IsEquationOneAndItsSigmaIsThatOfTheMean) {
  base::Random random(1);
  const Eigen::Isometry3d truth = somewhere(random);
  const Eigen::Vector3d marker(0.1, -0.2, 0.05), sigma(0.0002, 0.0003, 0.004);  // camera axes
  constexpr int kFrames = 60, kTrials = 2000;
  Eigen::Vector3d nees = Eigen::Vector3d::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    Points points;
    for (int i = 0; i < kFrames; ++i)
      points.push_back(truth.inverse() * marker + normalVector(random, sigma));
    const auto found = registerAtHardStop(points, truth.linear(), marker);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->frames, kFrames);
    EXPECT_NEAR(found->rms, sigma.norm(), 0.35 * sigma.norm());
    const Eigen::Vector3d error = found->base_from_camera.translation() - truth.translation();
    nees += error.cwiseQuotient(found->sigma).cwiseAbs2() / kTrials;
  }
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(nees(axis), 59.0 / 57.0, 0.15);  // t² with 59 degrees of freedom
}

TEST(RegisterAtHardStop, RefusesWhatGivesNoSigma) {
  const Points one{Eigen::Vector3d::Zero()};
  EXPECT_EQ(registerAtHardStop(one, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()).error(),
            RegistrationFault::kTooFewPoints);
  const Points broken{Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(std::nan(""))};
  EXPECT_EQ(registerAtHardStop(broken, Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()).error(),
            RegistrationFault::kNotFinite);
}

TEST(RegisterRigid, FindsTheTransformOfExactPoints) {
  base::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Isometry3d truth = somewhere(random);
    Points camera, base;
    const int count = 3 + trial % 6;
    for (int i = 0; i < count; ++i) {
      // Every third cloud is flat, where a careless solution mirrors.
      const double depth = trial % 3 == 0 ? 0.0 : 0.1;
      camera.push_back(normalVector(random, {0.1, 0.1, depth}) + Eigen::Vector3d(0, 0, 0.5));
      base.push_back(truth * camera.back());
    }
    const auto found = registerRigid(camera, base);
    ASSERT_TRUE(found);
    EXPECT_LT((found->base_from_camera.matrix() - truth.matrix()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(found->base_from_camera.linear().determinant(), 1.0, 1e-12);
    EXPECT_LT(found->rms, 1e-12);
  }
}

TEST(RegisterRigid, SigmaMatchesTheScatter) {
  base::Random random(3);
  const Eigen::Isometry3d truth = somewhere(random);
  Points camera, base;
  for (int i = 0; i < 12; ++i) {
    camera.push_back(normalVector(random, {0.08, 0.08, 0.05}) + Eigen::Vector3d(0.02, 0, 0.55));
    base.push_back(truth * camera.back());
  }
  constexpr int kTrials = 2000;
  Eigen::Vector3d nees = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Points noisy = camera;
    for (Eigen::Vector3d& point : noisy) point += normalVector(random, Eigen::Vector3d::Constant(1e-3));
    const auto found = registerRigid(noisy, base);
    ASSERT_TRUE(found);
    nees += (found->base_from_camera.translation() - truth.translation())
                .cwiseQuotient(found->sigma)
                .cwiseAbs2() /
            kTrials;
    squares += found->rms * found->rms / kTrials;
  }
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(nees(axis), 30.0 / 28.0, 0.15);  // t² with 30 degrees of freedom
  EXPECT_NEAR(squares, 3.0 * 1e-6 * 30.0 / 36.0, 0.1e-6);
}

TEST(RegisterRigid, RefusesDegenerateClouds) {
  const Points line{{0, 0, 0.5}, {0.1, 0.05, 0.5}, {0.2, 0.1, 0.5}, {0.4, 0.2, 0.5}};
  const Points spread{{0, 0, 0.5}, {0.1, 0, 0.5}, {0, 0.1, 0.5}, {0, 0, 0.6}};
  const Points same(4, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(registerRigid(line, line).error(), RegistrationFault::kCollinear);
  EXPECT_EQ(registerRigid(spread, line).error(), RegistrationFault::kCollinear);
  EXPECT_EQ(registerRigid(same, same).error(), RegistrationFault::kCollinear);
  const Points three(spread.begin(), spread.begin() + 3), two(spread.begin(), spread.begin() + 2);
  EXPECT_EQ(registerRigid(spread, three).error(), RegistrationFault::kUnequalCounts);
  EXPECT_EQ(registerRigid(two, two).error(), RegistrationFault::kTooFewPoints);
  Points broken = spread;
  broken[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(registerRigid(broken, spread).error(), RegistrationFault::kNotFinite);
}

}  // namespace
}  // namespace capstan::vision
