#include "core/registration/pair_registration.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <functional>
#include <random>

#include "core/vision/registration.h"
#include "core/vision/triangulation.h"

namespace capstan::registration {
namespace {

constexpr double kChiSquare6At95 = 12.592;

struct Set {
  std::vector<PointPair> pairs;
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
    set.pairs.push_back({camera, set.truth * camera + noise * vector()});
    if (i < outliers)
      set.pairs.back().base += 0.03 * vector().normalized() * (1.0 + std::abs(normal(random)));
  }
  return set;
}

TEST(PairRegistration, IsTheClosedFormWithoutOutliers) {
  const Set set = generated(5, 50, 0.0005, 0);
  const auto found = registerPairs(set.pairs);
  std::vector<Eigen::Vector3d> camera, base;
  for (const PointPair& pair : set.pairs) {
    camera.push_back(pair.camera);
    base.push_back(pair.base);
  }
  const auto closed = vision::registerRigid(camera, base);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(std::ranges::count(found.value().used, true), 50);
  EXPECT_LT((found.value().base_from_camera.matrix() - closed.value().base_from_camera.matrix()).norm(),
            1e-9);
}

TEST(PairRegistration, TruthIsWithinTheStatedIntervalAmongOutliers) {
  int inside = 0, outliers_used = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Set set = generated(1000 + seed, 50, 0.0005, 10);
    const auto found = registerPairs(set.pairs);
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

// Horn's closed form (1987): the rotation is the eigenvector of the largest eigenvalue of a symmetric 4 × 4
// matrix of the correlations. It shares no step with the singular value decomposition.
Eigen::Isometry3d byQuaternion(const std::vector<PointPair>& pairs) {
  Eigen::Vector3d camera = Eigen::Vector3d::Zero(), base = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) {
    camera += pair.camera / static_cast<double>(pairs.size());
    base += pair.base / static_cast<double>(pairs.size());
  }
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (const PointPair& pair : pairs) m += (pair.camera - camera) * (pair.base - base).transpose();
  Eigen::Matrix4d n;
  n << m.trace(), m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0),                   //
      m(1, 2) - m(2, 1), m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(0, 2) + m(2, 0),  //
      m(2, 0) - m(0, 2), m(0, 1) + m(1, 0), m(1, 1) - m(0, 0) - m(2, 2), m(1, 2) + m(2, 1),  //
      m(0, 1) - m(1, 0), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), m(2, 2) - m(0, 0) - m(1, 1);
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(n).eigenvectors().col(3);
  Eigen::Isometry3d fit = Eigen::Isometry3d::Identity();
  fit.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  fit.translation() = base - fit.linear() * camera;
  return fit;
}

TEST(PairRegistration, AgreesWithHornsQuaternions) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Set set = generated(2000 + seed, 50, 0.0005, 0);
    const auto found = registerPairs(set.pairs);
    ASSERT_TRUE(found.has_value());
    if (std::ranges::count(found->used, true) < 50) continue;  // one set in a hundred
    EXPECT_LT((found->base_from_camera.matrix() - byQuaternion(set.pairs).matrix()).norm(), 1e-9) << seed;
  }
}

// Pairs as two cameras measure them: 0.3 px on each pixel at 0.25 m make depth five times as uncertain.
Set seenByCameras(unsigned seed, int count) {
  Set set = generated(seed, count, 0.0, 0);
  vision::Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 572.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  vision::StereoRig rig{camera, camera, Eigen::Isometry3d(Eigen::Translation3d(-0.062, 0.0, 0.0))};
  const vision::Triangulator triangulator(rig);
  std::mt19937 random(seed);
  std::normal_distribution<double> pixels(0.0, 0.3);
  const auto noisy = [&](const Eigen::Vector2d& pixel) -> Eigen::Vector2d {
    return pixel + Eigen::Vector2d(pixels(random), pixels(random));
  };
  for (PointPair& pair : set.pairs) {
    const auto left = rig.left.project(pair.camera),
               right = rig.right.project(rig.right_from_left * pair.camera);
    pair.camera = triangulator.triangulate(noisy(*left), noisy(*right), 1.0, 1.0).position;
  }
  return set;
}

int insideOf200(const std::function<Set(unsigned)>& make) {
  int inside = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Set set = make(seed);
    const auto found = registerPairs(set.pairs);
    if (!found) continue;
    const Eigen::AngleAxisd turn(set.truth.rotation() * found->base_from_camera.rotation().transpose());
    Eigen::Matrix<double, 6, 1> error;
    error << turn.angle() * turn.axis(), set.truth.translation() - found->base_from_camera.translation();
    inside += error.dot(found->covariance.inverse() * error) <= kChiSquare6At95;
  }
  return inside;
}

TEST(PairRegistration, IntervalAllowsForTheDepthOfTheCameras) {
  const int inside = insideOf200([](unsigned seed) { return seenByCameras(3000 + seed, 50); });
  std::printf("pixels: inside the 95 %% region: %d of 200\n", inside);
  EXPECT_GE(inside, 180);
}

PairFault faultOf(const Set& set) {
  const auto found = registerPairs(set.pairs);
  EXPECT_FALSE(found.has_value());
  return found.has_value() ? PairFault::kTooFewPairs : found.error().fault;
}

TEST(PairRegistration, RefusesWhatIsNotDetermined) {
  EXPECT_EQ(faultOf(generated(1, 3, 0.0005, 0)), PairFault::kTooFewPairs);
  Set line = generated(2, 20, 0.0, 0);
  for (std::size_t i = 0; i < line.pairs.size(); ++i) {
    line.pairs[i].camera = Eigen::Vector3d(0.01 * static_cast<double>(i), 0.0, 0.3);
    line.pairs[i].base = line.truth * line.pairs[i].camera;
  }
  EXPECT_EQ(faultOf(line), PairFault::kCollinear);
  Set mirrored = generated(3, 20, 0.0005, 0);
  for (auto& pair : mirrored.pairs) pair.camera.x() = -pair.camera.x();
  EXPECT_EQ(faultOf(mirrored), PairFault::kMirrored);
  Set millimetres = generated(4, 20, 0.0005, 0);
  for (auto& pair : millimetres.pairs) pair.camera *= 1000.0;
  EXPECT_EQ(faultOf(millimetres), PairFault::kScale);
  Set larger = generated(7, 30, 0.0005, 9);
  for (auto& pair : larger.pairs) pair.camera *= 1.05;
  EXPECT_EQ(faultOf(larger), PairFault::kScale);
  Set inches = generated(8, 30, 0.0005, 9);
  for (auto& pair : inches.pairs) pair.camera /= 0.0254;
  EXPECT_EQ(faultOf(inches), PairFault::kScale);
  Set reversed = generated(6, 20, 0.0005, 0);
  for (std::size_t i = 0; i < 10; ++i) std::swap(reversed.pairs[i].base, reversed.pairs[19 - i].base);
  EXPECT_EQ(faultOf(reversed), PairFault::kScatter);
  Set two_wrong = generated(9, 5, 0.0005, 0);
  for (std::size_t i : {0U, 3U}) two_wrong.pairs[i].base += Eigen::Vector3d(0.5, -0.3, 0.4);
  EXPECT_EQ(faultOf(two_wrong), PairFault::kNoAgreement);
}

}  // namespace
}  // namespace capstan::registration
