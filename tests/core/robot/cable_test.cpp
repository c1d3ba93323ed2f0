#include "core/robot/cable.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace capstan::robot {
namespace {

TEST(Cable, isThePapersPairOfExponentials) {
  const double k = 720e3, a = 1.0, b = 4000.0;
  for (const double delta : {-0.3, -0.01, 0.02, 0.5})
    for (const double rate : {-0.1, 0.0, 0.2}) {
      const double paper = k * (std::exp(a * delta) - std::exp(-a * delta)) + 2.0 * b * rate;
      EXPECT_NEAR(cableForce(k, a, b, delta, rate), paper, 1e-13 * k);
    }
}

TEST(Cable, keepsEveryDigitOfATinyStretch) {
  const double k = 720e3, a = 3.0, delta = 1e-12;
  const double precise = 2.0 * k * a * delta;  // the cubic term is 1e-23 of it
  EXPECT_NEAR(cableForce(k, a, 0.0, delta, 0.0), precise, 4e-16 * precise);
  const double pair = k * (std::exp(a * delta) - std::exp(-a * delta));
  EXPECT_GT(std::abs(pair - precise), 1e-6 * precise);  // what the pair of exponentials loses
  EXPECT_EQ(cableForce(k, a, 0.0, 0.0, 0.0), 0.0);
}

TEST(Cable, longDouble) {
  EXPECT_NEAR(static_cast<double>(cableForce(1.0, 1.0, 0.5, 0.7L, 0.25L)), 2.0 * std::sinh(0.7) + 0.25,
              1e-15);
}

TEST(Cable, stiffnessIsTheSlopeOfTheForce) {
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
  const Dual stretch(0.4, 1, 0);
  const Dual force = cableForce(88e3, 2.0, 0.0, stretch, Dual(0.0));
  EXPECT_NEAR(force.derivatives()[0], cableStiffness(88e3, 2.0, 0.4), 1e-9);
}

TEST(Friction, isCoulombFarFromZeroAndSmoothAtIt) {
  EXPECT_NEAR(frictionForce(0.505, 0.00505, 5e-3, 1.0), 0.505 + 0.00505, 1e-15);
  EXPECT_NEAR(frictionForce(0.505, 0.00505, 5e-3, -1.0), -0.505 - 0.00505, 1e-15);
  EXPECT_EQ(frictionForce(0.505, 0.00505, 5e-3, 0.0), 0.0);
  const double v = 1e-9;
  EXPECT_NEAR(frictionForce(0.505, 0.00505, 5e-3, v) / v, 0.505 / 5e-3 + 0.00505, 1e-9);
}

}  // namespace
}  // namespace capstan::robot
