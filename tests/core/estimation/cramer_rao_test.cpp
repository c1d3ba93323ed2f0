#include "core/estimation/cramer_rao.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/base/random.h"

namespace capstan::estimation {
namespace {

using Scalar = Eigen::Matrix<double, 1, 1>;

Scalar scalar(double value) { return Scalar::Constant(value); }

/// x' = A x, linear whatever the point.
struct Rotation {
  static constexpr int kStates = 2;
  struct Input {};
  Eigen::Matrix2d a;
  void propagate(SigmaPoints<2>& points, const Input&, double) const { points = a * points; }
};

TEST(CramerRao, OfALinearGaussianModelIsTheKalmanCovariance) {
  Eigen::Matrix2d a, q, p;
  a << 0.98, 0.1, -0.15, 0.95;
  q << 0.02, 0.005, 0.005, 0.03;
  p << 2.0, 0.3, 0.3, 1.0;
  const Eigen::RowVector2d h(1.0, 0.4);
  const double r = 0.2;
  const Rotation model{a};
  CramerRaoAverage<2> average(60, q.inverse());
  base::Random random(1, "linear");
  for (int run = 0; run < 5; ++run) {
    for (std::size_t k = 0; k < 60; ++k) {
      const Eigen::Vector2d x(random.normal(), random.normal());
      average.addTransition(k, transitionJacobian(model, x, {}, 1.0, Eigen::Vector2d(1e-3, 1e-3)));
      if (k % 3 == 2) average.addMeasurement(k, h.transpose() * h / r);
    }
    average.endRun();
  }
  const auto bounds = average.bounds(p.inverse());
  for (std::size_t k = 0; k < 60; ++k) {
    p = a * p * a.transpose() + q;
    if (k % 3 == 2) {
      const double s = h * p * h.transpose() + r;
      p -= p * h.transpose() * h * p / s;
    }
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(bounds[k](i), p(i, i), 1e-9 * p(i, i)) << k;
  }
}

TEST(CramerRao, StretchesOfTimeOneAfterTheOtherAreTheWhole) {
  Eigen::Matrix2d a;
  a << 0.98, 0.1, -0.15, 0.95;
  const Eigen::Matrix2d inverse_q = Eigen::Vector2d(50.0, 30.0).asDiagonal(),
                        start = Eigen::Matrix2d::Identity();
  const Eigen::RowVector2d h(1.0, 0.4);
  CramerRaoAverage<2> whole(30, inverse_q), first(20, inverse_q), second(10, inverse_q);
  for (std::size_t k = 0; k < 30; ++k) {
    auto& part = k < 20 ? first : second;
    whole.addTransition(k, a);
    part.addTransition(k % 20, a);
    if (k % 4 != 3) continue;
    whole.addMeasurement(k, h.transpose() * h);
    part.addMeasurement(k % 20, h.transpose() * h);
  }
  for (auto* average : {&whole, &first, &second}) average->endRun();
  PosteriorInformation<2> posterior(start);
  auto bounds = first.bounds(posterior);
  const auto later = second.bounds(posterior);
  bounds.insert(bounds.end(), later.begin(), later.end());
  EXPECT_EQ(bounds, whole.bounds(start));
}

/// Random walk seen through a sine: x_k ~ N(m, s²), s² = P0 + k Q, so that E[cos² x] has a closed form and
/// the scalar recursion is J' = 1 / (Q + 1 / J) + (1 + exp(−2 s²) cos 2m) / (2 R).
TEST(CramerRao, OfAPhaseSeenThroughASineIsTheClosedForm) {
  constexpr std::size_t kSteps = 40;
  constexpr int kRuns = 20000;
  const double m = 0.7, p0 = 0.05, q = 0.02, r = 0.1;
  CramerRaoAverage<1> average(kSteps, scalar(1.0 / q));
  base::Random random(2, "phase");
  for (int run = 0; run < kRuns; ++run) {
    double x = random.normal(m, std::sqrt(p0));
    for (std::size_t k = 0; k < kSteps; ++k) {
      average.addTransition(k, scalar(1.0));
      x += random.normal(0.0, std::sqrt(q));
      average.addMeasurement(k, scalar(std::cos(x) * std::cos(x) / r));
    }
    average.endRun();
  }
  const auto bounds = average.bounds(scalar(1.0 / p0));
  double j = 1.0 / p0, s2 = p0;
  for (std::size_t k = 0; k < kSteps; ++k) {
    s2 += q;
    j = 1.0 / (q + 1.0 / j) + (1.0 + std::exp(-2.0 * s2) * std::cos(2.0 * m)) / (2.0 * r);
    EXPECT_NEAR(bounds[k](0) * j, 1.0, 0.01) << k;
  }
}

/// The univariate non-stationary growth model of Kitagawa (1987) and Gordon, Salmond and Smith (1993).
/// Oracle: the information matrix of the whole trajectory x_0 … x_n, block tri-diagonal (Tichavský's
/// (14)–(20)), whose inverse ends in the bound.
TEST(CramerRao, OfTheGrowthModelIsTheInverseOfTheWholeTrajectorysInformation) {
  constexpr int kSteps = 12, kRuns = 400;
  const double q = 10.0, r = 1.0, p0 = 5.0;
  const auto slope = [](double x) { return 0.5 + 25.0 * (1.0 - x * x) / ((1.0 + x * x) * (1.0 + x * x)); };
  CramerRaoAverage<1> first(kSteps, scalar(1.0 / q)), second(kSteps, scalar(1.0 / q));
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(kSteps + 1, kSteps + 1);
  whole(0, 0) = 1.0 / p0;
  base::Random random(3, "growth");
  for (int run = 0; run < kRuns; ++run) {
    CramerRaoAverage<1>& average = run < 100 ? first : second;
    double x = random.normal(0.0, std::sqrt(p0));
    for (int k = 0; k < kSteps; ++k) {
      const double f = slope(x);
      average.addTransition(static_cast<std::size_t>(k), scalar(f));
      whole(k, k) += f * f / q / kRuns;
      whole(k, k + 1) -= f / q / kRuns;
      whole(k + 1, k) -= f / q / kRuns;
      x = 0.5 * x + 25.0 * x / (1.0 + x * x) + 8.0 * std::cos(1.2 * k) + random.normal(0.0, std::sqrt(q));
      average.addMeasurement(static_cast<std::size_t>(k), scalar(x * x / 100.0 / r));
      whole(k + 1, k + 1) += (1.0 / q + x * x / 100.0 / r) / kRuns;
    }
    average.endRun();
  }
  first.merge(second);
  const auto bounds = first.bounds(scalar(1.0 / p0));
  EXPECT_NEAR(bounds.back()(0) / whole.inverse()(kSteps, kSteps), 1.0, 1e-9);
  EXPECT_GT(bounds.back()(0), 0.1);
  EXPECT_LT(bounds.back()(0), q);
}

}  // namespace
}  // namespace capstan::estimation
