// Two models written apart agree: what is planted, told in the words of a robot file, moves core's chain as
// it moves the planted plant; and these words are what the study takes for the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/robot/chain/chain_model.h"
#include "core/robot/chain/chain_state.h"
#include "core/robot/chain/chain_step.h"
#include "tests/support/planted/excitation.h"
#include "tests/support/planted_study/planted_numbers.h"
#include "tests/support_tests/planted_robots.h"

namespace capstan::study {
namespace {

using test::Effect;
using test::Planted;

constexpr double kTime = 4.0;          // [s]
constexpr std::size_t kObserved = 10;  // rows from one that is compared to the next
constexpr double kSlipAt = 0.4;        // of the time
constexpr int kParts = 8;              // of a row in the chain's steps: laws are compared here, not steps

/// The numbers of `planted` in the order in which core's effect has them.
std::vector<double> valuesOf(const Planted& e) {
  const double m = e.magnitude, s = e.signature;
  switch (e.effect) {
    case Effect::kCableCoupling:
      return {m, e.other + 1.0};
    case Effect::kEncoderSlip:
      return {m, e.phase * kTime};
    case Effect::kCapstanEccentricity:
    case Effect::kPositionFriction:
      break;
    case Effect::kCableHysteresis:
    case Effect::kCableCreep:
    case Effect::kStribeckFriction:
    case Effect::kZeroDrift:
      return {m, s};
    case Effect::kSlack:
      return {s * (1.0 - m)};
    case Effect::kHomingOffset:  // at the joint
    case Effect::kBacklash:      // spring and damper press only
      return {m, 0.0};
    case Effect::kPositionStiffness:  // by the free length
      return {m, 1.0};
    case Effect::kGravityTilt:
    case Effect::kCameraRotation:
    case Effect::kCameraOffset:
      return {m * e.axis.x(), m * e.axis.y(), m * e.axis.z()};
    default:
      return {m};
  }
  // e (sin(φ + p) − sin p) = e cos p sin φ + e sin p (cos φ − 1); m sin(x + p) = m cos p sin x + m sin p cos
  // x.
  if (e.effect == Effect::kCapstanEccentricity) return {m * std::sin(e.phase), m * std::cos(e.phase)};
  return {m * std::cos(e.phase), m * std::sin(e.phase), s};
}

robot::Effect inWords(const Planted& planted) {
  const test::EffectFacts& facts = test::factsOf(planted.effect);
  robot::Effect words{std::string(facts.name), facts.whole ? 0 : planted.joint + 1, {}};
  const std::vector<double> values = valuesOf(planted);
  const auto& parameters = robot::effectNamed(facts.name)->parameters;
  EXPECT_EQ(values.size(), parameters.size()) << facts.name;
  for (std::size_t k = 0; k < values.size(); ++k)
    words.values.push_back({std::string(parameters[k].name), values[k]});
  return words;
}

/// What joints and cameras tell, a line every kSeen rows.
using Told = std::vector<std::vector<double>>;

struct Bench {
  Bench(robot::Description description, bool rigid_drive)
      : robot(std::move(description)), rigid(rigid_drive) {
    base::Random random(21);
    const test::Excitation excitation(robot, kTime, random);
    test::PlantParameters parameters(robot, rigid);
    test::Joints push{};
    for (int i = 0; i < parameters.size; ++i) push[i] = 0.2 * parameters.coulomb[i];
    const test::ExternalLoad load(push, random);
    test::Plant plant(parameters, {});
    motion = drive(
        plant, robot, {}, [&](double t) { return excitation.at(t); }, [&](double t) { return load.at(t); },
        {kTime, 0.5});
  }

  Told byPlant(const std::vector<Planted>& effects) const {
    test::PlantParameters parameters(robot, rigid);
    for (const Planted& one : effects) plantInParameters(one, robot, parameters);
    parameters.refinement = 2;
    test::Plant plant(parameters, effects);
    const test::PlantedMotion moved = replay(plant, motion, effects);
    test::RigidChain chain(robot);
    Told commanded;
    for (std::size_t k = 0; k < moved.t.size(); k += kObserved) {
      std::vector<double>& line = commanded.emplace_back();
      for (int i = 0; i < robot.size(); ++i) line.push_back(moved.q[k][i]);
      const Eigen::Vector3d tip = cameraTip(moved, k, chain, robot.marker, effects);
      line.insert(line.end(), tip.begin(), tip.end());
    }
    return commanded;
  }

  /// Of the part'th of kParts pieces of a row.
  robot::ChainInput inputAt(std::size_t k, int part) const {
    robot::ChainInput input;
    input.dt = (motion.t[k + 1] - motion.t[k]) / kParts;
    input.t = motion.t[k] + part * input.dt;
    for (int i = 0; i < robot.size(); ++i) {
      const double from = motion.motor[k][i], way = motion.motor[k + 1][i] - from;
      input.motor[i] = from + way * part / kParts, input.motor_end[i] = from + way * (part + 1) / kParts;
      input.torque[i] = motion.torque[k][i];
      input.load[i] = motion.load[k][i], input.signed_load[i] = std::abs(motion.load[k][i]);
    }
    return input;
  }

  Told byChain(const std::vector<Planted>& effects) const {
    robot::ChainModel model(robot);
    for (const Planted& one : effects) model.add(inWords(one));
    robot::JointVector q(robot.size());
    for (int i = 0; i < robot.size(); ++i) q[i] = motion.q.front()[i];
    const int steps = 1;
    robot::ChainState<double> state = robot::stateAt(model, q, robot::JointVector::Zero(robot.size()));
    robot::ChainStep<double> step(model.shape, model.numbers);
    for (int i = 0; i < robot.size(); ++i) {  // as the plant has it: its cable carries gravity
      test::PlantParameters parameters(robot, rigid);
      for (const Planted& one : effects) plantInParameters(one, robot, parameters);
      state.motor[i] = test::Plant(parameters, {}).rest(motion.q.front())[test::kMotor][i];
    }
    test::PlantedMotion moved;
    for (std::size_t k = 0; k + 1 < motion.t.size(); ++k) {
      std::copy_n(state.q, robot::kChainJoints, moved.q.emplace_back().begin());
      for (int part = 0; part < kParts; ++part) step.advance(inputAt(k, part), steps, state);
    }
    test::RigidChain chain(robot);
    Told commanded;
    for (std::size_t k = 0; k < moved.q.size(); k += kObserved) {
      std::vector<double>& line =
          commanded.emplace_back(moved.q[k].begin(), moved.q[k].begin() + robot.size());
      Planted latency;
      latency.effect = Effect::kCameraLatency;
      latency.magnitude = model.camera.delay;
      const Eigen::Vector3d tip = model.camera.measure(cameraTip(moved, k, chain, robot.marker, {latency}));
      line.insert(line.end(), tip.begin(), tip.end());
    }
    return commanded;
  }

  robot::Description robot;
  bool rigid;
  test::PlantedMotion motion;
};

/// RMS of the difference, by column.
std::vector<double> apart(const Told& a, const Told& b) {
  std::vector<double> rms(a.front().size());
  const std::size_t lines = std::min(a.size(), b.size());
  for (std::size_t k = 0; k < lines; ++k)
    for (std::size_t c = 0; c < rms.size(); ++c) rms[c] += (a[k][c] - b[k][c]) * (a[k][c] - b[k][c]);
  for (double& x : rms) x = std::sqrt(x / static_cast<double>(lines));
  return rms;
}

Planted large(Effect effect, const Bench& bench, base::Random& random) {
  const auto joints = test::jointsFor(effect, test::optionsFor(bench.robot, bench.rigid));
  const test::PlantParameters parameters(bench.robot, bench.rigid);
  Planted planted =
      test::largestPlausible(effect, std::max(joints.back() - 1, 0), parameters, bench.robot, random);
  if (effect == Effect::kEncoderSlip) planted.phase = kSlipAt;
  return planted;
}

/// What the effect changes in the one model it changes in the other, to a hundredth in the channel that shows
/// most of it. Of hysteresis it is a seventh: its loop wanders with the way that the motor takes between two
/// rows, a cubic there, a straight line here.
void expectSameChange(const Bench& bench, const Planted& planted, const Told& plant, const Told& chain) {
  const std::string_view name = test::factsOf(planted.effect).name;
  const Told with = bench.byPlant({planted}), with_chain = bench.byChain({planted});
  const std::vector<double> change = apart(with, plant), wrong = apart(with, with_chain),
                            base = apart(plant, chain);
  double most = 0.0, share = 0.0;
  for (std::size_t c = 0; c < change.size(); ++c)
    if (change[c] / (base[c] + 1e-9) > most)
      most = change[c] / (base[c] + 1e-9), share = wrong[c] / change[c];
  EXPECT_LT(share, planted.effect == Effect::kCableHysteresis ? 0.14 : 0.01)
      << name << " on joint " << planted.joint + 1;
}

void expectEveryEffect(const Bench& bench) {
  base::Random random(5);
  const Told plant = bench.byPlant({}), chain = bench.byChain({});
  for (const test::EffectFacts& facts : test::allEffects())
    if (facts.covered && (bench.rigid ? facts.rigid : facts.cable) &&
        !test::jointsFor(facts.effect, test::optionsFor(bench.robot, bench.rigid)).empty())
      expectSameChange(bench, large(facts.effect, bench, random), plant, chain);
}

TEST(PlantedLaws, OfCableDrivesAreTheChains) { expectEveryEffect(Bench(test::raven(), false)); }

TEST(PlantedLaws, OfRigidDrivesAreTheChains) {
  expectEveryEffect(Bench(test::rigidRobot("rigid_arm"), true));
}

TEST(PlantedLaws, TheWordsAreWhatTheStudyTakesForTheTruth) {
  const Bench bench(test::raven(), false), rigid(test::rigidRobot("rigid_arm"), true);
  base::Random random(5);
  for (const test::EffectFacts& facts : test::allEffects()) {
    if (!facts.covered) continue;
    const Planted planted = large(facts.effect, facts.cable ? bench : rigid, random);
    const robot::Effect words = inWords(planted);
    NamedCause found{words.effect, words.joint, 1.0, {}};
    for (const auto& value : words.values)
      found.numbers.push_back({value.parameter, value.value, 1e-9 * std::abs(value.value)});
    const HiddenTruth truth{{{words.effect, words.joint, 1.0, 10.0, planted}}, {}, kTime, 0.0};
    for (const NumberCheck& check : checkNumbers(truth, 0, found))
      EXPECT_TRUE(check.inside()) << facts.name << " " << check.name << ": " << check.planted << ", found "
                                  << check.found;
  }
}

}  // namespace
}  // namespace capstan::study
