#include "core/robot/arm_dynamics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "core/base/error.h"
#include "core/robot/chain_dynamics.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using Eigen::Vector3d;
using LongVector = Eigen::Matrix<long double, 3, 1>;

/// RAVEN-II with everything that its file has at zero set to something: the closed form holds for all such
/// arms.
Description lopsided() {
  Description robot = testing::raven("right");
  robot.gravity = {3.0, -5.0, -7.0};
  robot.joints[2].dh.d = 0.07;
  robot.joints[2].link.centre_of_mass = {0.02, -0.03, -0.11};
  return robot;
}

class Arms : public ::testing::TestWithParam<int> {
 protected:
  Description robot_ = GetParam() == 0   ? testing::raven("left")
                       : GetParam() == 1 ? testing::raven("right")
                                         : lopsided();
  ArmDynamics arm_{robot_};
  ChainDynamics chain_{robot_};
  base::Random random_{7};
};

INSTANTIATE_TEST_SUITE_P(LeftRightLopsided, Arms, ::testing::Range(0, 3));

TEST_P(Arms, closedFormIsTheRecursiveOne) {
  for (int k = 0; k < 10'000; ++k) {
    const Vector3d q = testing::randomVector(random_, 3.0), dq = testing::randomVector(random_, 3.0);
    const Vector3d ddq = testing::randomVector(random_, 20.0);
    const Vector3d tau = arm_.inverse(q, dq, ddq);
    ASSERT_LT((tau - chain_.inverse(q, dq, ddq)).norm(), 1e-12 * (1.0 + tau.norm()));
    ASSERT_LT((arm_.massMatrix(q) - chain_.massMatrix(q)).norm(), 1e-13 * arm_.massMatrix(q).norm());
    ASSERT_LT((arm_.bias(q, dq) - chain_.bias(q, dq)).norm(), 1e-12 * (1.0 + tau.norm()));
    ASSERT_LT((arm_.forward(q, dq, tau) - ddq).norm(), 1e-9);
  }
}

TEST_P(Arms, energyIsConservedWithoutFriction) {
  Vector3d q(0.7, 1.5, 0.35), dq(0.5, -0.8, 0.1);
  const auto energy = [&] { return chain_.kineticEnergy(q, dq) + chain_.potentialEnergy(q); };
  const double at_first = energy();
  const double kinetic_at_first = chain_.kineticEnergy(q, dq);
  constexpr double kStep = 1e-4;
  const Vector3d no_torque = Vector3d::Zero();
  double most_kinetic = 0.0;
  for (int k = 0; k < 5000; ++k) {  // Runge–Kutta 4, half a second of falling and swinging
    const Vector3d a1 = arm_.forward(q, dq, no_torque);
    const Vector3d q2 = q + 0.5 * kStep * dq, v2 = dq + 0.5 * kStep * a1;
    const Vector3d a2 = arm_.forward(q2, v2, no_torque);
    const Vector3d q3 = q + 0.5 * kStep * v2, v3 = dq + 0.5 * kStep * a2;
    const Vector3d a3 = arm_.forward(q3, v3, no_torque);
    const Vector3d q4 = q + kStep * v3, v4 = dq + kStep * a3;
    const Vector3d a4 = arm_.forward(q4, v4, no_torque);
    q += kStep / 6.0 * (dq + 2.0 * v2 + 2.0 * v3 + v4);
    dq += kStep / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    most_kinetic = std::max(most_kinetic, chain_.kineticEnergy(q, dq));
  }
  EXPECT_GT(most_kinetic, 2.0 * kinetic_at_first);
  EXPECT_NEAR(energy(), at_first, 1e-10 * most_kinetic);
}

TEST_P(Arms, longDoubleAgrees) {
  const Vector3d q(0.7, 1.5, 0.35), dq(0.5, -0.8, 0.1), tau(1.0, -0.5, 3.0);
  const LongVector precise =
      arm_.forward<long double>(q.cast<long double>(), dq.cast<long double>(), tau.cast<long double>());
  const Vector3d plain = arm_.forward(q, dq, tau);
  EXPECT_LT((precise - plain.cast<long double>()).norm(), 1e-13L * precise.norm());
  EXPECT_NE(precise[0], static_cast<long double>(plain[0]));
}

TEST_P(Arms, automaticDerivativesAreThoseOfDifferences) {
  using Dual = Eigen::AutoDiffScalar<Vector3d>;
  using DualVector = Eigen::Matrix<Dual, 3, 1>;
  const Vector3d q(0.7, 1.5, 0.35), dq(0.5, -0.8, 0.1), tau(1.0, -0.5, 3.0);
  DualVector dual_q, dual_dq, dual_tau;
  for (int i = 0; i < 3; ++i) {
    dual_q[i] = Dual(q[i], Vector3d::Unit(i));
    dual_dq[i] = Dual(dq[i], Vector3d::Zero());
    dual_tau[i] = Dual(tau[i], Vector3d::Zero());
  }
  const DualVector ddq = arm_.forward<Dual>(dual_q, dual_dq, dual_tau);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const Vector3d h = kStep * Vector3d::Unit(i);
    const Vector3d slope =
        (arm_.forward<double>(q + h, dq, tau) - arm_.forward<double>(q - h, dq, tau)) / (2.0 * kStep);
    for (int row = 0; row < 3; ++row)
      EXPECT_NEAR(ddq[row].derivatives()[i], slope[row], 1e-7 * (1.0 + slope.norm()));
  }
}

TEST_P(Arms, packsHoldSeveralArmsSideBySide) {
  using Pack [[gnu::vector_size(16)]] = double;
  const ArmConstants& k = arm_.constants();
  std::array<Vector3d, 2> q, dq, tau;
  ArmTrig<Pack> trig;
  Pack q3;
  std::array<Pack, 3> dq_pack, tau_pack;
  for (std::size_t lane = 0; lane < 2; ++lane) {
    q[lane] = testing::randomVector(random_, 1.0);
    dq[lane] = testing::randomVector(random_, 1.0);
    tau[lane] = testing::randomVector(random_, 1.0);
    trig.sin1[lane] = std::sin(q[lane][0]);
    trig.cos1[lane] = std::cos(q[lane][0]);
    trig.sin2[lane] = std::sin(q[lane][1]);
    trig.cos2[lane] = std::cos(q[lane][1]);
    q3[lane] = q[lane][2];
    for (int i = 0; i < 3; ++i) {
      dq_pack[static_cast<std::size_t>(i)][lane] = dq[lane][i];
      tau_pack[static_cast<std::size_t>(i)][lane] = tau[lane][i];
    }
  }
  const std::array<Pack, 3> ddq = armForward(k, trig, q3, dq_pack, tau_pack);
  for (std::size_t lane = 0; lane < 2; ++lane) {
    const Vector3d alone = arm_.forward(q[lane], dq[lane], tau[lane]);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ddq[static_cast<std::size_t>(i)][lane], alone[i], 1e-13 * (1.0 + alone.norm()));
  }
}

TEST(ArmTrig, isExactToTheLastBits) {
  base::Random random(17);
  double worst = 0.0;
  const auto see = [&](double ours, long double exact) {
    worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(ours) - exact)));
  };
  for (int k = 0; k < 300'000; ++k) {
    const double size = std::pow(10.0, random.uniform(-9.0, 5.5));  // beyond 1e5 the C library's
    const double near_quarter = (k % 40 - 20) * 1.5707963267948966;
    const double q1 = random.uniform(-size, size),
                 q2 = near_quarter + random.normal(0.0, std::min(1.0, size));
    const ArmTrig<double> trig = armTrig(q1, q2);
    see(trig.sin1, std::sin(static_cast<long double>(q1)));
    see(trig.cos1, std::cos(static_cast<long double>(q1)));
    see(trig.sin2, std::sin(static_cast<long double>(q2)));
    see(trig.cos2, std::cos(static_cast<long double>(q2)));
  }
  fmt::print("sine and cosine within {:.2e}\n", worst);
  EXPECT_LE(worst, 1.5e-16);
}

TEST(ArmTrig, smallAnglesKeepTheirDigitsAndNonsenseStaysNonsense) {
  EXPECT_EQ(armTrig(0.0, 1e-200).sin1, 0.0);
  EXPECT_EQ(armTrig(0.0, 1e-200).sin2, 1e-200);
  EXPECT_EQ(armTrig(0.0, -1e-9).sin2, std::sin(-1e-9));
  EXPECT_TRUE(std::isnan(armTrig(std::nan(""), 0.3).sin1));
  EXPECT_EQ(armTrig(std::nan(""), 0.3).sin2, std::sin(0.3));
}

TEST(ArmDynamics, refusesArmsWithoutARemoteCentre) {
  Description robot = testing::raven();
  robot.joints[1].dh.d = 0.1;
  EXPECT_THROW(ArmDynamics{robot}, base::InputError);
}

}  // namespace
}  // namespace capstan::robot
