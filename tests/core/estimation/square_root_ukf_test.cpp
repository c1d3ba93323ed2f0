#include "core/estimation/square_root_ukf.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/support/counting_new.h"
#include "tests/support/ukf_reference.h"

namespace capstan::estimation {
namespace {

using State = Eigen::Vector4d;
using Matrix = Eigen::Matrix4d;
using Joint = LinearMeasurement<4, 2>;

/// x⁺ = F x + G u, a pair of damped masses.
struct LinearModel {
  static constexpr int kStates = 4;
  using Input = Eigen::Vector2d;
  Matrix f(double dt) const {
    Matrix a;
    a << 0, 1, 0, 0, -9, -0.4, 4, 0, 0, 0, 0, 1, 4, 0, -6, -0.2;
    return Matrix::Identity() + a * dt + 0.5 * dt * dt * a * a;
  }
  State g(const Input& u, double dt) const { return {0.0, u(0) * dt, 0.0, u(1) * dt}; }
  void propagate(SigmaPoints<4>& x, const Input& u, double dt) const {
    x = (f(dt) * x).eval();
    x.colwise() += g(u, dt);
  }
};

/// A measurement model that the filter cannot see through to its matrix: takes the sigma-point path.
struct Opaque {
  static constexpr int kOutputs = 2;
  Joint inner;
  void observe(const SigmaPoints<4>& x, OutputPoints<4, 2>& y) const { inner.observe(x, y); }
};

/// Range and bearing of a point with positions (x0, x2).
struct Polar {
  static constexpr int kOutputs = 2;
  template <class T>
  static Eigen::Matrix<T, 2, 1> of(const Eigen::Matrix<T, 4, 1>& x) {
    using std::atan2;
    using std::sqrt;
    return {sqrt(x(0) * x(0) + x(2) * x(2)), atan2(x(2), x(0))};
  }
  void observe(const SigmaPoints<4>& x, OutputPoints<4, 2>& y) const {
    for (int c = 0; c < x.cols(); ++c) y.col(c) = of<double>(x.col(c));
  }
};

/// A pendulum with quadratic drag, beside a point that drifts with it.
struct Swing {
  static constexpr int kStates = 4;
  struct Input {};
  template <class T>
  static Eigen::Matrix<T, 4, 1> next(const Eigen::Matrix<T, 4, 1>& x, T dt) {
    using std::abs;
    using std::sin;
    return {x(0) + dt * x(1), x(1) + dt * (T(-2) * sin(x(0)) - x(1) * abs(x(1)) / T(10)), x(2) + dt * x(3),
            x(3) + dt * (sin(x(0)) - x(3)) / T(4)};
  }
  void propagate(SigmaPoints<4>& x, const Input&, double dt) const {
    for (int c = 0; c < x.cols(); ++c) x.col(c) = next<double>(x.col(c), dt);
  }
};

Joint joint() {
  Joint measurement;
  measurement.h(0, 0) = 1.0;
  measurement.h(1, 0) = 0.3;
  measurement.h(1, 2) = 1.0;
  return measurement;
}

Lower<4> noiseRoot() {
  Lower<4> q = Lower<4>::Zero();
  q.diagonal() << 1e-4, 1e-2, 1e-4, 1e-2;
  q(3, 1) = 4e-3;
  return q;
}

Lower<2> outputRoot() {
  Lower<2> r = Lower<2>::Zero();
  r << 0.02, 0.0, 0.01, 0.03;
  return r;
}

template <class Measurement>
double distanceFromKalman(const Measurement& measurement) {
  const LinearModel model;
  const Lower<4> sq = noiseRoot();
  const Lower<2> sr = outputRoot();
  const Matrix q = sq * sq.transpose();
  const Eigen::Matrix2d r = sr * sr.transpose();
  const Eigen::Matrix<double, 2, 4> h = joint().h;
  SquareRootUkf<4> filter;
  State mean(1.0, 0.0, -0.5, 0.2);
  Matrix p = Matrix::Identity();
  filter.reset(mean, Lower<4>::Identity());
  base::Random random(9);
  double worst = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double dt = random.uniform(0.005, 0.02);
    const Eigen::Vector2d u(std::sin(0.01 * k), std::cos(0.013 * k)), y(random.normal(), random.normal());
    filter.predict(model, u, dt, sq);
    mean = model.f(dt) * mean + model.g(u, dt);
    p = model.f(dt) * p * model.f(dt).transpose() + q;

    const auto report = filter.update(measurement, y, sr);
    const Eigen::Vector2d innovation = y - h * mean;
    const Eigen::Matrix2d s = h * p * h.transpose() + r;
    const Eigen::Matrix<double, 4, 2> gain = p * h.transpose() * s.inverse();
    const Matrix keep = Matrix::Identity() - gain * h;
    EXPECT_TRUE(report.applied);
    worst = std::max({worst, (report.innovation - innovation).norm(),
                      (report.root * report.root.transpose() - s).norm(),
                      std::abs(report.nis / innovation.dot(s.inverse() * innovation) - 1.0)});
    mean += gain * innovation;
    p = keep * p * keep.transpose() + gain * r * gain.transpose();
    worst = std::max({worst, (filter.mean() - mean).norm(), (filter.covariance() - p).norm()});
  }
  EXPECT_EQ(filter.rescues(), 0U);
  return worst;
}

TEST(SquareRootUkf, LinearCaseIsTheKalmanFilter) {
  EXPECT_LT(distanceFromKalman(joint()), 1e-9);
  EXPECT_LT(distanceFromKalman(Opaque{joint()}), 1e-9);
}

TEST(SquareRootUkf, AgreesWithTextbookUkfInLongDouble) {
  using Real = long double;
  using RealState = Eigen::Matrix<Real, 4, 1>;
  SquareRootUkf<4> filter;
  test::UkfReference<Real, 4> reference;
  const State start(1.0, 0.0, 2.0, 0.2);
  const Lower<4> root = 0.1 * Lower<4>::Identity();
  filter.reset(start, root);
  reference.reset(start.cast<Real>(), (root * root.transpose()).cast<Real>());
  const Eigen::Matrix<Real, 4, 4> q = noiseRoot().cast<Real>() * noiseRoot().cast<Real>().transpose();
  const Eigen::Matrix<Real, 2, 2> r = outputRoot().cast<Real>() * outputRoot().cast<Real>().transpose();
  State truth = start + 0.05 * State::Ones();
  base::Random random(10);
  double mean = 0.0, covariance = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double dt = 0.01;
    truth = Swing::next<double>(truth, dt);
    const Eigen::Vector2d y =
        Polar::of<double>(truth) + Eigen::Vector2d(random.normal(0.0, 0.02), random.normal(0.0, 0.03));
    filter.predict(Swing{}, {}, dt, noiseRoot());
    reference.predict([&](const RealState& x) { return Swing::next<Real>(x, Real(dt)); }, q);
    filter.update(Polar{}, y, outputRoot());
    reference.update<2>([](const RealState& x) { return Polar::of<Real>(x); }, y.cast<Real>(), r);
    mean = std::max(mean, (filter.mean() - reference.mean().cast<double>()).norm());
    const Matrix p = reference.covariance().cast<double>();
    covariance = std::max(covariance, (filter.covariance() - p).norm() / p.norm());
  }
  EXPECT_LT(mean, 1e-11);
  EXPECT_LT(covariance, 1e-11);
}

TEST(SquareRootUkf, RescueGivesWhatTheDowndateShould) {
  Lower<4> wide = 1e3 * Lower<4>::Identity();
  wide(2, 0) = 300.0;
  const Lower<2> sharp = 1e-6 * Lower<2>::Identity();
  const Eigen::Vector2d y(3.0, -2.0);
  SquareRootUkf<4> through_points, direct;
  through_points.reset(State::Zero(), wide);
  direct.reset(State::Zero(), wide);
  const auto report = through_points.update(Opaque{joint()}, y, sharp);
  direct.update(joint(), y, sharp);
  EXPECT_TRUE(report.rescued);
  EXPECT_TRUE(report.applied);
  EXPECT_EQ(through_points.rescues(), 1U);
  EXPECT_EQ(direct.rescues(), 0U);
  // Observed directions: the noise's own size, of which the roundings of 1e3 are 1e-7.
  const Eigen::Matrix2d seen = joint().h * through_points.covariance() * joint().h.transpose();
  EXPECT_LT((seen - 1e-12 * Eigen::Matrix2d::Identity()).norm(), 1e-4 * 1e-12);
  EXPECT_LT((through_points.covariance() - direct.covariance()).norm(), 1e-9 * direct.covariance().norm());
  EXPECT_LT((through_points.mean() - direct.mean()).norm(), 1e-9);
}

/// Points beyond 10 explode.
struct Exploding {
  static constexpr int kStates = 4;
  struct Input {};
  void propagate(SigmaPoints<4>& x, const Input&, double) const {
    x = (x.array().abs() > 10.0).select(std::numeric_limits<double>::infinity(), x);
  }
};

TEST(SquareRootUkf, NothingNonFiniteGetsIn) {
  SquareRootUkf<4> filter;
  const State mean(1.0, 2.0, 3.0, 4.0);
  filter.reset(mean, Lower<4>(100.0 * Lower<4>::Identity()));
  EXPECT_FALSE(filter.predict(Exploding{}, {}, 0.1, Lower<4>(3.0 * Lower<4>::Identity())));
  EXPECT_EQ(filter.mean(), mean);
  EXPECT_NEAR((filter.covariance() - 10009.0 * Matrix::Identity()).norm(), 0.0, 1e-9);
  EXPECT_EQ(filter.rescues(), 1U);

  const Matrix before = filter.covariance();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(filter.update(joint(), Eigen::Vector2d(nan, 0.0), outputRoot()).applied);
  EXPECT_FALSE(filter.update(Opaque{joint()}, Eigen::Vector2d(0.0, nan), outputRoot()).applied);
  EXPECT_FALSE(filter.update(joint(), Eigen::Vector2d(1.0, 1.0), Lower<2>(nan * outputRoot())).applied);
  EXPECT_EQ(filter.mean(), mean);
  EXPECT_EQ(filter.covariance(), before);
  EXPECT_EQ(filter.rescues(), 4U);
}

TEST(SquareRootUkf, PeekChangesNothing) {
  SquareRootUkf<4> filter;
  filter.reset(State(1.0, 2.0, 3.0, 4.0), noiseRoot());
  const Eigen::Vector2d y(0.4, 0.9);
  const auto ahead = filter.peek(joint(), y, outputRoot());
  EXPECT_EQ(filter.mean(), State(1.0, 2.0, 3.0, 4.0));
  EXPECT_EQ(filter.squareRoot(), noiseRoot());
  EXPECT_EQ(ahead.nis, filter.update(joint(), y, outputRoot()).nis);
}

TEST(SquareRootUkf, AllocatesNothing) {
  SquareRootUkf<4> filter;
  filter.reset(State::Zero(), noiseRoot());
  const std::size_t before = test::allocations();
  for (int k = 0; k < 100; ++k) {
    filter.predict(Swing{}, {}, 0.01, noiseRoot());
    filter.update(joint(), Eigen::Vector2d(0.1, 0.2), outputRoot());
    filter.update(Polar{}, Eigen::Vector2d(0.1, 0.2), outputRoot());
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace capstan::estimation
