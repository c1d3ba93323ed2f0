#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/random.h"
#include "core/estimation/consistency.h"
#include "core/estimation/square_root_ukf.h"
#include "core/tracking/cable_arm_model.h"
#include "tests/core/tracking/cable_arm_scene.h"
#include "tests/support/cable_arm_reference.h"
#include "tests/support/counting_new.h"
#include "tests/support/ukf_reference.h"

namespace capstan::tracking {
namespace {

using estimation::Lower;
using Filter = estimation::SquareRootUkf<6>;
using Joints = estimation::LinearMeasurement<6, 3>;
using State = CableArmModel::State;

Joints joints() {
  Joints h;
  for (int i = 0; i < 3; ++i) h.h(i, 2 * i) = 1.0;
  return h;
}

State sigmas(double q, double dq) {
  State s;
  s << q, dq, q, dq, 0.1 * q, 0.1 * dq;
  return s;
}

State noise(base::Random& random, const State& sigma) {
  return State::NullaryExpr([&](Eigen::Index i) { return random.normal(0.0, sigma(i)); });
}

TEST(CableArmFilter, AgreesWithTextbookUkfInLongDouble) {
  using Real = long double;
  using Reference = capstan::test::CableArmReference<Real>;
  using RealState = Reference::State;
  const CableArmModel model(raven());
  const Reference arm(raven());
  Filter filter;
  capstan::test::UkfReference<Real, 6> reference;
  const State p0 = sigmas(0.02, 0.1), q = sigmas(1e-5, 1e-2);
  const Eigen::Vector3d r(2e-3, 2e-3, 5e-4);
  State start;
  start << 0.8, 0.0, 1.7, 0.0, 0.41, 0.0;
  filter.reset(start, Lower<6>(p0.asDiagonal()));
  const auto squared = [](const auto& sigma) { return sigma.template cast<Real>().cwiseAbs2().eval(); };
  using RealMatrix = Eigen::Matrix<Real, 6, 6>;
  reference.reset(start.cast<Real>(), RealMatrix(squared(p0).asDiagonal()));
  const auto real = [](const MotorState& m) {
    return Reference::Motor{m.position.cast<Real>(), m.velocity.cast<Real>()};
  };
  const double dt = 1e-3;
  double mean = 0.0, covariance = 0.0;
  for (int k = 0; k < 300; ++k) {
    const MotorState begin = test::motorAt(k * dt, 0.0), end = test::motorAt((k + 1) * dt, 0.0);
    filter.predict(model, CableArmModel::interval(begin, end), dt, Lower<6>(q.asDiagonal()));
    reference.predict(
        [&](const RealState& x) {
          return arm.propagate(x, real(begin), real(end), Real(dt), model.stepsFor(dt));
        },
        RealMatrix(squared(q).asDiagonal()));
    if (k % 5 == 0) {
      const Eigen::Vector3d y(0.8 + 1e-3 * std::sin(k), 1.7 + 1e-3 * std::cos(k),
                              0.41 + 2e-4 * std::sin(2.0 * k));
      filter.update(joints(), y, Lower<3>(r.asDiagonal()));
      reference.update<3>([](const RealState& x) { return Eigen::Matrix<Real, 3, 1>(x(0), x(2), x(4)); },
                          y.cast<Real>(), Eigen::Matrix<Real, 3, 3>(squared(r).asDiagonal()));
    }
    mean = std::max(mean, (filter.mean() - reference.mean().cast<double>()).cwiseAbs().maxCoeff());
    const Eigen::Matrix<double, 6, 6> p = reference.covariance().cast<double>();
    covariance = std::max(covariance, (filter.covariance() - p).norm() / p.norm());
  }
  std::printf("largest distance from long double: mean %.2g, covariance %.2g (relative)\n", mean, covariance);
  EXPECT_LT(mean, 1e-11);
  EXPECT_LT(covariance, 1e-11);
  EXPECT_EQ(filter.rescues(), 0U);
}

TEST(CableArmFilter, MatchedModelIsConsistentOver200Runs) {
  constexpr int kRuns = 200, kSteps = 1000, kEvery = 20;
  const double dt = 1e-3;
  const CableArmModel model(raven());
  const State p0 = sigmas(5e-3, 2e-2), q = sigmas(1e-5, 2e-3);
  const Lower<6> root_q = q.asDiagonal();
  const Eigen::Vector3d r(2e-3, 2e-3, 3e-4);
  const Lower<3> root_r = r.asDiagonal();
  double nees_last = 0.0, nis_all = 0.0;
  std::int64_t updates = 0;
  std::uint64_t rescues = 0;
  for (int run = 0; run < kRuns; ++run) {
    base::Random random(static_cast<std::uint64_t>(run), "matched model");
    const double phase = random.uniform(0.0, 6.0);
    State truth;
    truth << 0.8 + 0.3 * std::sin(phase), 0.0, 1.6 + 0.25 * std::sin(phase + 1.0), 0.0,
        0.4 + 0.05 * std::sin(phase + 2.0), 0.0;
    Filter filter;
    filter.reset(truth, Lower<6>(p0.asDiagonal()));
    truth += noise(random, p0);
    for (int k = 0; k < kSteps; ++k) {
      const auto input =
          CableArmModel::interval(test::motorAt(k * dt, phase), test::motorAt((k + 1) * dt, phase));
      truth = model.propagateOne(truth, input, dt) + noise(random, q);
      filter.predict(model, input, dt, root_q);
      if ((k + 1) % kEvery != 0) continue;
      Eigen::Vector3d y(truth(0), truth(2), truth(4));
      for (int i = 0; i < 3; ++i) y(i) += random.normal(0.0, r(i));
      nis_all += filter.update(joints(), y, root_r).nis;
      ++updates;
    }
    nees_last += estimation::nees<6>(filter.mean() - truth, filter.squareRoot());
    rescues += filter.rescues();
  }
  const double nees = nees_last / (6.0 * kRuns), nis = nis_all / (3.0 * static_cast<double>(updates));
  const estimation::Band nees_band = estimation::chiSquareBand(6, kRuns);
  const estimation::Band nis_band = estimation::chiSquareBand(3, updates);
  std::printf(
      "%d runs: mean NEES / 6 = %.4f, 95 %% band [%.4f, %.4f]; mean NIS / 3 = %.4f over %lld, band [%.4f, "
      "%.4f]\n",
      kRuns, nees, nees_band.low, nees_band.high, nis, static_cast<long long>(updates), nis_band.low,
      nis_band.high);
  EXPECT_TRUE(nees_band.contains(nees));
  EXPECT_TRUE(nis_band.contains(nis));
  EXPECT_EQ(rescues, 0U);
}

/// 10⁶ steps in all: every pairing of R and P0 from 1e-12 to 1e6, dt jittered by half.
TEST(CableArmFilter, NothingNonFiniteInAMillionSteps) {
  constexpr int kDecades = 10;
  constexpr int kSteps = 1000000 / (kDecades * kDecades);
  const CableArmModel model(raven());
  const Lower<6> root_q = sigmas(1e-5, 1e-2).asDiagonal();
  std::uint64_t rescues = 0, refused = 0;
  for (int a = 0; a < kDecades; ++a)
    for (int b = 0; b < kDecades; ++b) {
      base::Random random(static_cast<std::uint64_t>(kDecades * a + b), "stress");
      const double r = std::pow(10.0, -12.0 + 2.0 * a), p0 = std::pow(10.0, -12.0 + 2.0 * b);
      Filter filter;
      State start;
      start << 0.8, 0.0, 1.6, 0.0, 0.4, 0.0;
      filter.reset(start, Lower<6>(std::sqrt(p0) * Lower<6>::Identity()));
      const Lower<3> root_r = std::sqrt(r) * Lower<3>::Identity();
      MotorState before = test::motorAt(0.0, 0.0);
      double t = 0.0;
      for (int k = 0; k < kSteps; ++k) {
        const double dt = 1e-3 * random.uniform(0.5, 1.5);
        t += dt;
        const MotorState now = test::motorAt(t, 0.0);
        filter.predict(model, CableArmModel::interval(before, now), dt, root_q);
        if (k % 10 == 0) {
          const double sigma = std::min(std::sqrt(r), 1.0);
          const Eigen::Vector3d y(0.8 + random.normal(0.0, sigma), 1.6 + random.normal(0.0, sigma),
                                  0.4 + random.normal(0.0, sigma));
          refused += !filter.update(joints(), y, root_r).applied;
        }
        before = now;
        ASSERT_TRUE(filter.mean().allFinite() && filter.squareRoot().allFinite())
            << "R " << r << ", P0 " << p0;
      }
      rescues += filter.rescues();
    }
  std::printf("10^6 steps: rescues %llu, refused measurements %llu\n",
              static_cast<unsigned long long>(rescues), static_cast<unsigned long long>(refused));
  EXPECT_EQ(refused, 0U);
}

TEST(CableArmFilter, AllocatesNothing) {
  const CableArmModel model(raven());
  Filter filter;
  filter.reset(State::Constant(0.5), Lower<6>(0.01 * Lower<6>::Identity()));
  const std::size_t before = capstan::test::allocations();
  for (int k = 0; k < 100; ++k) {
    filter.predict(model, CableArmModel::interval({}, {}), 1e-3, Lower<6>(1e-3 * Lower<6>::Identity()));
    filter.update(joints(), Eigen::Vector3d(0.5, 0.5, 0.5), Lower<3>(1e-2 * Lower<3>::Identity()));
  }
  EXPECT_EQ(capstan::test::allocations(), before);
}

}  // namespace
}  // namespace capstan::tracking
