#include "core/math/rk4.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

namespace capstan::math {
namespace {

TEST(Rk4, IsTheFourthOrderTaylorPolynomialOnLinearSystems) {
  for (const double z : {-2.0, -0.3, 1e-9, 0.0, 0.7}) {
    const double next = rk4Step([&](double, double x) { return z * x; }, 0.0, 3.0, 1.0);
    EXPECT_NEAR(next, 3.0 * (1.0 + z + z * z / 2 + z * z * z / 6 + z * z * z * z / 24), 1e-15);
  }
}

TEST(Rk4, IsExactForCubicsInTime) {
  const double next = rk4Step([](double t, double) { return 4.0 * t * t * t; }, 1.0, 0.0, 2.0);
  EXPECT_DOUBLE_EQ(next, 81.0 - 1.0);
}

TEST(Rk4, ErrorFallsWithTheFourthPower) {
  const auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x(1), -x(0)); };
  const auto error = [&](int steps) {
    Eigen::Vector2d x(1.0, 0.0);
    for (int i = 0; i < steps; ++i) x = rk4Step(oscillator, 0.0, x, 1.0 / steps);
    return (x - Eigen::Vector2d(std::cos(1.0), -std::sin(1.0))).norm();
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4.0, 0.05);
}

}  // namespace
}  // namespace capstan::math
