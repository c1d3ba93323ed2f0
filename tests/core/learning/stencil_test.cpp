// Velocities beside derivatives in closed form.
#include "core/learning/poses/stencil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/learning/poses/rotation_vector.h"

namespace capstan::learning {
namespace {

TEST(Stencil, hasTheWeightsOfTheBookOnEvenStamps) {
  const std::vector<double> t = {0.0, 0.5, 1.0, 1.5, 2.0};
  const double expected[] = {1.0, -8.0, 0.0, 8.0, -1.0};  // over 12 h (Abramowitz and Stegun, 25.3.6)
  const std::vector<double> weights = derivativeWeights(t, 1.0);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(weights[k], expected[k] / 6.0, 1e-12);
}

/// Uneven stamps of a hundredth of a second or so.
std::vector<double> unevenStamps(std::size_t n) {
  base::Random random(4, "stamps");
  std::vector<double> t;
  for (double now = 3.0; t.size() < n; now += random.uniform(0.006, 0.014)) t.push_back(now);
  return t;
}

TEST(Stencil, isExactForPolynomialsOfTheFourthOrderOnUnevenStamps) {
  const std::vector<double> t = unevenStamps(30);
  Eigen::Matrix3Xd x(3, 30);
  for (Eigen::Index k = 0; k < 30; ++k) {
    const double s = t[static_cast<std::size_t>(k)] - 3.1;
    x.col(k) << 1.0 + 2.0 * s, s * s * s, 5.0 * std::pow(s, 4) - s * s;
  }
  const Eigen::Matrix3Xd v = velocitiesOf(t, x);
  for (Eigen::Index k = 0; k < 30; ++k) {
    const double s = t[static_cast<std::size_t>(k)] - 3.1;
    EXPECT_NEAR(v(0, k), 2.0, 1e-9);
    EXPECT_NEAR(v(1, k), 3.0 * s * s, 1e-9);
    EXPECT_NEAR(v(2, k), 20.0 * std::pow(s, 3) - 2.0 * s, 1e-9);
  }
}

TEST(Stencil, makesTheBestOfFewPoses) {
  const std::vector<double> two = {0.0, 0.1};
  Eigen::Matrix3Xd x(3, 2);
  x << 0.0, 1.0, 0.0, 2.0, 0.0, 3.0;
  EXPECT_LT((velocitiesOf(two, x).col(1) - Eigen::Vector3d(10.0, 20.0, 30.0)).norm(), 1e-9);
  EXPECT_EQ(velocitiesOf(std::vector<double>{1.0}, x.leftCols(1)), Eigen::Matrix3Xd::Zero(3, 1));
  EXPECT_EQ(velocitiesOf({}, Eigen::Matrix3Xd(3, 0)).cols(), 0);
}

TEST(Stencil, turnsAtTheSpeedOfAScrew) {
  const std::vector<double> t = unevenStamps(40);
  const Eigen::Vector3d speed(1.5, -2.0, 0.7);  // fixed in the frame that turns
  const Eigen::Quaterniond start(Eigen::AngleAxisd(2.8, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()));
  std::vector<Eigen::Quaterniond> turns;
  for (const double now : t) turns.push_back(start * turnBy(now * speed));
  for (std::size_t k = 0; k < turns.size(); k += 3) turns[k].coeffs() *= -1.0;  // the same turn
  const Eigen::Matrix3Xd commanded = angularVelocitiesOf(t, turns);
  for (Eigen::Index k = 0; k < commanded.cols(); ++k) EXPECT_LT((commanded.col(k) - speed).norm(), 1e-9);
}

TEST(RotationVector, leadsThereAndBack) {
  base::Random random(1, "rotation vectors");
  for (const double size : {0.0, 1e-12, 1e-6, 0.3, 2.0, 3.14}) {
    Eigen::Vector3d v(random.normal(0.0, 1.0), random.normal(0.0, 1.0), random.normal(0.0, 1.0));
    v = size * v.normalized();
    EXPECT_LT((rotationVector(turnBy(v)) - v).norm(), 1e-9 + 1e-12 * size) << size;
    Eigen::Quaterniond other = turnBy(v);
    other.coeffs() *= -1.0;
    EXPECT_LT((rotationVector(other) - v).norm(), 1e-9) << size;
  }
}

}  // namespace
}  // namespace capstan::learning
