// Each law at a point worked out by hand, and what it must not do.
#include "core/robot/chain/chain_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

#include "core/base/random.h"

namespace capstan::robot {
namespace {

/// Neutral in every effect.
JointNumbers<double> plainNumbers() {
  JointNumbers<double> p{};
  p.lever = 5e-4, p.inverse_gear = 0.1;
  p.link_radius = 0.06;
  p.stiffness = 1000.0, p.exponent = 100.0, p.damping = 20.0;
  p.slip_time = 1.0;
  p.pretension = kSound;
  p.zero_drift_rate = p.inverse_yield = p.creep_rate = p.inverse_stribeck = p.wave_number = 1.0;
  p.coulomb = 0.5, p.viscous = 0.1, p.inverse_smoothing = 100.0;
  p.gain = p.length_share = 1.0;
  p.motor_inertia = 3e-5, p.motor_coulomb = 0.02, p.motor_viscous = 1e-4, p.inverse_motor_smoothing = 2.0;
  return p;
}

double pullOf(const JointNumbers<double>& p, unsigned laws, double x, double rate = 0.0, double range = 0.0,
              double z = 0.0, double creep = 0.0) {
  return cablePull(p, laws | kLawExponential, x, rate, range, z, creep).force;
}

TEST(ChainLaw, aCableIsAnExponentialPairWithDamping) {
  const JointNumbers<double> p = plainNumbers();
  EXPECT_NEAR(pullOf(p, 0, 2e-3, 0.1), 1000.0 * (std::exp(0.2) - std::exp(-0.2)) + 2.0 * 20.0 * 0.1, 1e-9);
}

TEST(ChainLaw, gentleCablesNeedNoExponential) {
  JointNumbers<double> p = plainNumbers();
  p.exponent = 1.0;
  for (const double x : {-0.01, -1e-3, 1e-4, 5e-3})
    EXPECT_NEAR(cablePull(p, 0, x, 0.0, 0.0, 0.0, 0.0).force, pullOf(p, 0, x),
                1e-9 * std::abs(pullOf(p, 0, x)));
}

TEST(ChainLaw, anEccentricCapstanHasARadiusThatTurnsWithIt) {
  JointNumbers<double> p = plainNumbers();
  p.eccentric_cosine = 3e-4, p.eccentric_sine = -2e-4;
  EXPECT_NEAR(motorTravel(p, kLawEccentricity, 7.0),  // phi = 0.7
              3.5e-3 + 3e-4 * std::sin(0.7) - 2e-4 * (std::cos(0.7) - 1.0), 1e-15);
  const double h = 1e-5;
  const double slope =
      (motorTravel(p, kLawEccentricity, 7.0 + h) - motorTravel(p, kLawEccentricity, 7.0 - h)) / (2.0 * h);
  EXPECT_NEAR(slope, 5e-4 + 0.1 * (3e-4 * std::cos(0.7) + 2e-4 * std::sin(0.7)), 1e-9 * slope);
  EXPECT_EQ(motorTravel(p, kLawEccentricity, 0.0), 0.0);  // counted from the stop
}

TEST(ChainLaw, slipComesAtItsTimeAndStays) {
  JointNumbers<double> p = plainNumbers();
  p.slip = 0.4;
  EXPECT_EQ(slipAt(p, 0.999), 0.0);
  EXPECT_NEAR(slipAt(p, 1.0 + 0.5 * kSlipTime), 0.2, 1e-12);
  EXPECT_NEAR(slipAt(p, 1.0 + kSlipTime), 0.4, 1e-12);
  EXPECT_NEAR(slipAt(p, 50.0), 0.4, 1e-12);
}

TEST(ChainLaw, aZeroDriftsFromTheBeginAndSettles) {
  JointNumbers<double> p = plainNumbers();
  p.zero_drift = 0.03, p.zero_drift_rate = 0.25;  // T = 4 s
  EXPECT_EQ(zeroShiftAt(p, -1.0).by, 0.0);
  EXPECT_EQ(zeroShiftAt(p, -1.0).rate, 0.0);
  EXPECT_EQ(zeroShiftAt(p, 0.0).by, 0.0);
  EXPECT_NEAR(zeroShiftAt(p, 0.0).rate, 0.03 / 4.0, 1e-15);
  EXPECT_NEAR(zeroShiftAt(p, 4.0).by, 0.03 * (1.0 - std::exp(-1.0)), 1e-15);
  EXPECT_NEAR(zeroShiftAt(p, 4.0).rate, 0.03 / 4.0 * std::exp(-1.0), 1e-15);
  EXPECT_NEAR(zeroShiftAt(p, 400.0).by, 0.03, 1e-15);
}

TEST(ChainLaw, stiffeningAddsACubic) {
  JointNumbers<double> p = plainNumbers();
  p.stiffening = 1e5;
  EXPECT_NEAR(pullOf(p, kLawStiffening, 2e-3) - pullOf(p, 0, 2e-3), 2.0 * 1000.0 * 100.0 * 1e5 * 8e-9, 1e-9);
}

TEST(ChainLaw, aLongerFreeCableIsSofter) {
  JointNumbers<double> p = plainNumbers();
  p.position_stiffness = 0.25;
  EXPECT_NEAR(pullOf(p, kLawPositionStiffness, 2e-3, 0.0, 1.0), pullOf(p, 0, 2e-3) / 1.25, 1e-9);
  EXPECT_NEAR(pullOf(p, kLawPositionStiffness, 2e-3, 0.0, -1.0), pullOf(p, 0, 2e-3) / 0.75, 1e-9);
  EXPECT_EQ(pullOf(p, kLawPositionStiffness, 2e-3, 0.0, 50.0),
            pullOf(p, kLawPositionStiffness, 2e-3, 0.0, 1.2));
}

TEST(ChainLaw, stiffnessItselfCanBeLinearInThePosition) {
  JointNumbers<double> p = plainNumbers();
  p.position_stiffness = 0.25;
  p.length_share = 0.0;
  EXPECT_DOUBLE_EQ(positionShare(p, 1.0), 0.75);
  EXPECT_DOUBLE_EQ(positionShare(p, -1.0), 1.25);
  p.length_share = 0.5;  // between the two forms
  EXPECT_DOUBLE_EQ(positionShare(p, 1.0), 0.875 / 1.125);
  p.position_stiffness = 0.8, p.length_share = 2.0;
  for (double range = -1.2; range <= 1.2; range += 0.1) {
    EXPECT_GE(positionShare(p, range), 0.02) << range;  // no cable pushes
    EXPECT_LE(positionShare(p, range), 50.0) << range;
  }
}

TEST(ChainLaw, playTransmitsNothingWithinAndPressesOutside) {
  JointNumbers<double> p = plainNumbers();
  p.play = 1e-3;
  EXPECT_EQ(pullOf(p, kLawPlay, 0.9e-3, 0.5), 0.0);
  EXPECT_EQ(pullOf(p, kLawPlay, -0.9e-3, -0.5), 0.0);
  EXPECT_NEAR(pullOf(p, kLawPlay, 3e-3, 0.1), 2000.0 * std::sinh(0.2) + 4.0, 1e-9);
  EXPECT_NEAR(pullOf(p, kLawPlay, -3e-3, -0.1), -(2000.0 * std::sinh(0.2) + 4.0), 1e-9);
  EXPECT_EQ(pullOf(p, kLawPlay, 1.01e-3, -1.0), 0.0);  // it leaves fast: the damper does not pull it back
}

TEST(ChainLaw, theDamperOfAPlayPressesOrActsWhileClosedOrAlways) {
  JointNumbers<double> p = plainNumbers();
  p.play = 1e-3;
  const double spring = 2000.0 * std::sinh(1e-3), damper = -40.0;  // at 1.01 mm, leaving at 1 m/s
  const auto leaving = [&] { return cablePull(p, kLawPlay | kLawExponential, 1.01e-3, -1.0, 0.0, 0.0, 0.0); };
  const auto within = [&] { return cablePull(p, kLawPlay | kLawExponential, 0.9e-3, 0.5, 0.0, 0.0, 0.0); };
  p.play_damping = 1.0;
  EXPECT_NEAR(leaving().force, spring + damper, 1e-9);
  EXPECT_EQ(leaving().damping, 40.0);
  EXPECT_EQ(within().force, 0.0);
  EXPECT_EQ(within().damping, 0.0);
  p.play_damping = 2.0;
  EXPECT_NEAR(leaving().force, spring + damper, 1e-9);
  EXPECT_EQ(within().force, 20.0);
  EXPECT_EQ(within().damping, 40.0);
  p.play_damping = 0.25;
  EXPECT_NEAR(leaving().force, 0.25 * (spring + damper), 1e-9);
  p.play_damping = 1.25;
  EXPECT_NEAR(within().force, 0.25 * 20.0, 1e-12);
  for (p.play_damping = 0.0; p.play_damping <= 2.0; p.play_damping += 0.5)
    EXPECT_NEAR(pullOf(p, kLawPlay, 3e-3, 0.1), 2000.0 * std::sinh(0.2) + 4.0, 1e-9);  // pressed: all alike
}

TEST(ChainLaw, aSlackCableOfAPairBearsNothing) {
  JointNumbers<double> p = plainNumbers();
  p.pretension = 1e-3;
  EXPECT_NEAR(pullOf(p, kLawSlack, 0.5e-3, 0.1), 2.0 * 1000.0 * 100.0 * 0.5e-3 + 2.0 * 20.0 * 0.1, 1e-9);
  EXPECT_NEAR(pullOf(p, kLawSlack, 2e-3, 0.1), 1000.0 * 100.0 * 3e-3 + 20.0 * 0.1, 1e-9);
  EXPECT_NEAR(pullOf(p, kLawSlack, -2e-3, -0.1), -(1000.0 * 100.0 * 3e-3 + 20.0 * 0.1), 1e-9);
  p.pretension = -1e-3;  // both too long
  EXPECT_EQ(pullOf(p, kLawSlack, 0.9e-3, 1.0), 0.0);
  EXPECT_NEAR(pullOf(p, kLawSlack, 1.5e-3), 1000.0 * 100.0 * 0.5e-3, 1e-9);
}

TEST(ChainLaw, hysteresisLoadsUnloadsAndSaturates) {
  JointNumbers<double> p = plainNumbers();
  p.hysteresis_force = 30.0, p.inverse_yield = 1e4;
  const auto at = [&](double rate, double z) { return cablePull(p, kLawHysteresis, 0.0, rate, 0.0, z, 0.0); };
  EXPECT_NEAR(at(0.0, 4e-5).force, 30.0 * 0.4, 1e-12);
  EXPECT_NEAR(at(0.2, 4e-5).hysteresis_rate, 0.2 * (1.0 - 0.4), 1e-15);  // further in: less and less
  EXPECT_NEAR(at(-0.2, 4e-5).hysteresis_rate, -0.2, 1e-15);              // back: at full stiffness
  EXPECT_NEAR(at(0.2, 1e-4).hysteresis_rate, 0.0, 1e-15);
  // Over a closed cycle it takes work and never gives any.
  double z = 0.0, work = 0.0;
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 400000; ++k) {
    const double rate = 2e-3 * std::cos(kStep * k * 6.283185307179586);
    const CablePull<double> pull = at(rate, z);
    if (k >= 200000) work += 30.0 * 1e4 * z * rate * kStep;
    z += kStep * pull.hysteresis_rate;
    ASSERT_LE(std::abs(z), 1e-4 * (1.0 + 1e-9));
  }
  EXPECT_GT(work, 0.0);
}

TEST(ChainLaw, creepLengthensTheCableUnderLoad) {
  JointNumbers<double> p = plainNumbers();
  p.creep_share = 0.5, p.creep_rate = 0.1;
  const CablePull<double> pull = cablePull(p, kLawCreep | kLawExponential, 3e-3, 0.0, 0.0, 0.0, 1e-3);
  EXPECT_NEAR(pull.force, 2000.0 * std::sinh(0.2), 1e-9);
  EXPECT_NEAR(pull.creep_rate, (0.5 * 2e-3 - 1e-3) * 0.1, 1e-18);  // in balance at share times the rest
}

TEST(ChainLaw, frictionHasAllItsParts) {
  JointNumbers<double> p = plainNumbers();
  const double v = 0.03, sign = std::tanh(3.0);
  EXPECT_NEAR(jointFriction(p, 0, 0.2, v, 4.0).force, 0.5 * sign + 0.1 * v, 1e-15);
  p.stribeck_excess = 0.8, p.inverse_stribeck = 50.0;
  EXPECT_NEAR(jointFriction(p, kLawStribeck, 0.2, v, 4.0).force,
              0.5 * (1.0 + 0.8 * std::exp(-2.25)) * sign + 0.1 * v, 1e-15);
  p.asymmetry = 0.3;
  EXPECT_NEAR(jointFriction(p, kLawAsymmetry, 0.2, -v, 4.0).force, -0.5 * 0.7 * sign - 0.1 * v, 1e-15);
  EXPECT_NEAR(jointFriction(p, kLawAsymmetry | kLawStribeck, 0.2, v, 4.0).force,
              0.5 * 1.3 * (1.0 + 0.8 * std::exp(-2.25)) * sign + 0.1 * v, 1e-15);
  p.wave_sine = 0.2, p.wave_cosine = -0.1, p.wave_number = 10.0;
  EXPECT_NEAR(jointFriction(p, kLawWave, 0.2, v, 4.0).force,
              0.5 * (1.0 + 0.2 * std::sin(2.0) - 0.1 * std::cos(2.0)) * sign + 0.1 * v, 1e-15);
  p.load_friction = 0.05;
  EXPECT_NEAR(jointFriction(p, kLawLoadFriction, 0.2, v, -4.0).force, (0.5 + 0.2) * sign + 0.1 * v, 1e-15);
  p.viscous_asymmetry = 0.4;
  const Opposing<double> backwards = jointFriction(p, kLawAsymmetricViscosity, 0.2, -v, 4.0);
  EXPECT_NEAR(backwards.force, -0.5 * sign - 0.1 * 0.6 * v, 1e-15);
}

TEST(ChainLaw, frictionNeverDrives) {
  base::Random random(3);
  JointNumbers<double> p = plainNumbers();
  constexpr unsigned kAll =
      kLawStribeck | kLawAsymmetry | kLawWave | kLawLoadFriction | kLawAsymmetricViscosity;
  for (int k = 0; k < 10000; ++k) {
    p.stribeck_excess = random.uniform(0.0, 2.0), p.inverse_stribeck = 1.0 / random.uniform(1e-3, 1.0);
    p.asymmetry = random.uniform(-0.5, 0.5);
    p.wave_sine = random.uniform(-0.3, 0.3), p.wave_cosine = random.uniform(-0.3, 0.3);
    p.load_friction = random.uniform(0.0, 1.0);
    p.viscous_asymmetry = random.uniform(-1.0, 1.0);
    const double v = random.uniform(-1.0, 1.0);
    EXPECT_GE(v * jointFriction(p, kAll, random.uniform(-2.0, 2.0), v, random.uniform(-5.0, 5.0)).force, 0.0);
  }
}

TEST(ChainLaw, motorsRubAndHiddenCablesGive) {
  JointNumbers<double> p = plainNumbers();
  EXPECT_NEAR(motorFriction(p, 0.7).force, 0.02 * std::tanh(1.4) + 1e-4 * 0.7, 1e-18);
  p.compliance = 2e-5;
  EXPECT_NEAR(complianceForce(p, 1e-3, 0.0), 50.0, 1e-12);
  EXPECT_NEAR(complianceForce(p, 0.0, 0.1), 0.2 / 5e-4 * std::sqrt(5e4 * 3e-5) * 0.1, 1e-9);
}

/// Law of a cable and numbers at which it acts.
struct ActingLaw {
  unsigned law;
  void (*act)(JointNumbers<double>&);
};
constexpr ActingLaw kCableLaws[] = {
    {kLawStiffening, [](JointNumbers<double>& p) { p.stiffening = 2e5; }},
    {kLawPositionStiffness, [](JointNumbers<double>& p) { p.position_stiffness = 0.3; }},
    {kLawPlay, [](JointNumbers<double>& p) { p.play = 4e-4, p.play_damping = 0.7; }},
    {kLawSlack, [](JointNumbers<double>& p) { p.pretension = 5e-4; }},
    {kLawHysteresis, [](JointNumbers<double>& p) { p.hysteresis_force = 20.0; }},
    {kLawCreep, [](JointNumbers<double>& p) { p.creep_share = 0.2; }},
};

// Robots with different laws are simulated side by side, and then every robot has all their laws in use.
TEST(ChainLaw, aCableLawWithNeutralNumbersChangesNothingBesideOtherLaws) {
  constexpr unsigned kAll = 1u << std::size(kCableLaws);
  base::Random random(7);
  for (unsigned set = 0; set < kAll; ++set) {
    JointNumbers<double> p = plainNumbers();
    unsigned own = kLawExponential, all = kLawExponential;
    for (std::size_t k = 0; k < std::size(kCableLaws); ++k) {
      all |= kCableLaws[k].law;
      if ((set >> k & 1u) == 0) continue;
      own |= kCableLaws[k].law;
      kCableLaws[k].act(p);
    }
    for (int k = 0; k < 50; ++k) {
      const double x = random.uniform(-2e-3, 2e-3), rate = random.uniform(-0.1, 0.1),
                   range = random.uniform(-1.0, 1.0),
                   z = own & kLawHysteresis ? random.uniform(-1.0, 1.0) : 0.0,
                   creep = own & kLawCreep ? random.uniform(-1e-4, 1e-4) : 0.0;
      const CablePull<double> alone = cablePull(p, own, x, rate, range, z, creep),
                              beside = cablePull(p, all, x, rate, range, z, creep);
      EXPECT_EQ(alone.force, beside.force) << "set " << set;
      EXPECT_EQ(alone.damping, beside.damping) << "set " << set;
    }
  }
}

TEST(ChainLaw, withNeutralNumbersALawChangesNothing) {
  const JointNumbers<double> p = plainNumbers();
  base::Random random(4);
  for (int k = 0; k < 1000; ++k) {
    const double x = random.uniform(-2e-3, 2e-3), v = random.uniform(-0.1, 0.1);
    EXPECT_EQ(motorTravel(p, kLawEccentricity, 1e3 * x), motorTravel(p, 0, 1e3 * x));
    for (const unsigned law :
         {kLawStribeck, kLawAsymmetry, kLawWave, kLawLoadFriction, kLawAsymmetricViscosity})
      EXPECT_EQ(jointFriction(p, law, x, v, 3.0).force, jointFriction(p, 0, x, v, 3.0).force) << law;
  }
  EXPECT_EQ(slipAt(p, 5.0), 0.0);
  EXPECT_EQ(zeroShiftAt(p, 5.0).by, 0.0);
}

}  // namespace
}  // namespace capstan::robot
