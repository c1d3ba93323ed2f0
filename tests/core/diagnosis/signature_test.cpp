// A residual with a known cause shows it against the right variable, with the share that it has; noise shows
// nothing.
#include "core/diagnosis/residuals/signature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/core/diagnosis/synthetic.h"

namespace capstan::diagnosis {
namespace {

struct Found {
  std::vector<Variable> variables;
  std::map<std::string, Signature> signatures;
  double of(const std::string& variable) const { return signatures.at(variable).share; }
};

/// Signatures of joint 1's residual.
Found signaturesIn(const Scene& s, std::size_t channel = 0) {
  Found found{variablesOf(s.evidence, s.simulated, s.robot), {}};
  const std::vector<Channel> channels = residualOf(s.evidence, s.simulated, s.robot);
  for (const Signature& signature : signaturesOf(channels[channel], found.variables))
    found.signatures[signature.variable] = signature;
  return found;
}

/// Adds `effect(row)` and white noise to joint 1. Returns the effect's share of the variance of both.
double add(Scene& s, double noise, std::uint64_t seed, const std::function<double(std::size_t)>& effect) {
  base::Random random(seed, "added");
  double sum = 0.0, squares = 0.0;
  const auto n = static_cast<double>(s.evidence.rows());
  for (std::size_t i = 0; i < s.evidence.rows(); ++i) {
    const double e = effect(i);
    sum += e / n, squares += e * e / n;
    s.evidence.q[0][i] += e + random.normal(0.0, noise);
  }
  const double variance = squares - sum * sum;
  return variance / (variance + noise * noise);
}

TEST(Variables, AreAllThatThereIsUnderTheirNames) {
  Scene s = scene(2, 5.0, 1);
  const std::vector<Variable> all = variablesOf(s.evidence, s.simulated, s.robot);
  std::vector<std::string> names;
  for (const Variable& variable : all) {
    names.push_back(variable.name);
    EXPECT_EQ(variable.values.size(), s.evidence.rows());
  }
  for (const char* name : {"position of joint 1", "direction of joint 2", "velocity of joint 1",
                           "acceleration of joint 2", "motor torque of joint 1", "joint torque of joint 2",
                           "motor angle of joint 1", "capstan angle of joint 2", "time"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  EXPECT_EQ(all.size(), 17U);
  s.simulated.tau.clear();
  s.evidence.tau_m[1][7] = std::nan("");
  EXPECT_EQ(variablesOf(s.evidence, s.simulated, s.robot).size(), 14U);
}

TEST(Variables, ADirectionHasARest) {
  Scene s = scene(1, 6.0, 1);
  for (std::size_t i = 0; i < s.evidence.rows(); ++i) {
    const double t = s.evidence.t[i];
    s.simulated.q[0][i] = t < 2.0 ? t : t < 4.0 ? 2.0 : 6.0 - t;
  }
  const auto all = variablesOf(s.evidence, s.simulated, s.robot);
  const auto direction = std::find_if(all.begin(), all.end(), [](const Variable& variable) {
    return variable.kind == VariableKind::kDirection;
  });
  EXPECT_EQ(direction->values[1000], 1.0);
  EXPECT_EQ(direction->values[3000], 0.0);
  EXPECT_EQ(direction->values[5000], -1.0);
}

TEST(Variables, MotorAnglesOfARigidDriveFollowFromItsJoints) {
  Scene s = scene(2, 2.0, 1);
  const auto with = variablesOf(s.evidence, s.simulated, s.robot);
  s.evidence.q_m.clear();
  const auto without = variablesOf(s.evidence, s.simulated, s.robot);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t v = 0; v < with.size(); ++v)
    if (with[v].kind == VariableKind::kMotorAngle) {
      for (std::size_t i = 0; i < s.evidence.rows(); ++i)
        ASSERT_NEAR(with[v].values[i], without[v].values[i], 1e-9);
    }
}

TEST(Signature, ASineOfTheMotorAngleShowsItsShareThereAndNowhereElse) {
  Scene s = scene(3, 60.0, 11);
  const auto& q_m = s.evidence.q_m[0];
  const double share = add(s, 1e-3, 1, [&](std::size_t i) { return 2e-3 * std::sin(q_m[i] + 0.7); });
  const Found found = signaturesIn(s);
  EXPECT_NEAR(share, 0.667, 0.02);
  EXPECT_NEAR(found.of("motor angle of joint 1"), share, 0.02);
  for (const auto& [name, signature] : found.signatures) {
    if (name == "motor angle of joint 1") continue;
    EXPECT_LT(signature.share, 0.25 * share) << name;
  }
  EXPECT_LT(found.of("position of joint 2"), 0.02);
  EXPECT_LT(found.of("time"), 0.02);
  // The curve itself: mean of the sine over each bin, within its interval (95 % of 24; allow three out).
  int out = 0;
  for (const SignatureBin& bin : found.signatures.at("motor angle of joint 1").bins) {
    const double truth = 2e-3 * (std::cos(bin.low + 0.7) - std::cos(bin.high + 0.7)) / (bin.high - bin.low);
    EXPECT_NEAR(bin.mean, truth, 2e-4);
    out += !bin.interval.contains(truth);
  }
  EXPECT_LE(out, 3);
}

TEST(Signature, EachCauseLeadsItsOwnVariable) {
  const struct {
    const char* variable;
    std::function<double(const Scene&, std::size_t)> effect;
  } causes[] = {
      {"position of joint 2",
       [](const Scene& s, std::size_t i) { return 5e-3 * s.simulated.q[1][i] * s.simulated.q[1][i]; }},
      {"joint torque of joint 1", [](const Scene& s, std::size_t i) { return 1e-3 * s.simulated.tau[0][i]; }},
      {"capstan angle of joint 1",
       [](const Scene& s, std::size_t i) { return 1.5e-3 * std::cos(s.evidence.q_m[0][i] / 60.0); }},
      {"time", [](const Scene& s, std::size_t i) { return 5e-5 * s.evidence.t[i]; }},
  };
  for (const auto& cause : causes) {
    Scene s = scene(2, 60.0, 21);
    for (auto& turns : s.evidence.q_m[0]) turns *= 5.0;
    const double share = add(s, 3e-4, 2, [&](std::size_t i) { return cause.effect(s, i); });
    const Found found = signaturesIn(s);
    EXPECT_GT(found.of(cause.variable), 0.9 * share) << cause.variable;
    for (const auto& [name, signature] : found.signatures) {
      // A motor torque that is the joint's own is the same variable.
      if (name == cause.variable || name == "motor torque of joint 1") continue;
      EXPECT_LT(signature.share, found.of(cause.variable)) << cause.variable << " and " << name;
    }
  }
}

TEST(Signature, FrictionLikeGapsShowAgainstTheDirection) {
  Scene s = scene(1, 40.0, 5);
  const auto variables = variablesOf(s.evidence, s.simulated, s.robot);
  const auto direction = std::find_if(variables.begin(), variables.end(), [](const Variable& variable) {
    return variable.kind == VariableKind::kDirection;
  });
  const double share = add(s, 1e-3, 3, [&](std::size_t i) { return 1e-3 * direction->values[i]; });
  const Signature found = signaturesIn(s).signatures.at("direction of joint 1");
  EXPECT_NEAR(found.share, share, 0.02);
  ASSERT_GE(found.bins.size(), 2U);
  EXPECT_NEAR(found.bins.front().mean, -1e-3, 1e-4);
  EXPECT_NEAR(found.bins.back().mean, 1e-3, 1e-4);
}

/// Noise of any memory: no share but by chance, as often below 0 as above, and intervals that hold 0.
TEST(Signature, NoiseExplainsNothing) {
  for (const double memory : {1e-6, 0.05, 0.4}) {
    double sum = 0.0, count = 0.0, highest = 0.0, within = 0.0, bins = 0.0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Scene s = scene(2, 60.0, seed, 4e-3);
      base::Random random(seed, "noise");
      const auto e = slowNoise(random, s.evidence.rows(), 4e-3, memory, 1e-3);
      for (std::size_t i = 0; i < e.size(); ++i) s.evidence.q[0][i] += e[i];
      for (const auto& [name, signature] : signaturesIn(s).signatures) {
        sum += signature.share, count += 1.0, highest = std::max(highest, signature.share);
        for (const SignatureBin& bin : signature.bins) {
          if (std::isnan(bin.interval.low)) continue;
          within += bin.interval.contains(0.0), bins += 1.0;
        }
      }
    }
    EXPECT_NEAR(sum / count, 0.0, 0.01) << memory;
    EXPECT_LT(highest, 0.15) << memory;
    EXPECT_GT(within / bins, 0.90) << memory;
    EXPECT_LT(within / bins, 0.985) << memory;
  }
}

/// Without regard to dependence the intervals would be far too short.
TEST(Signature, IntervalsKnowThatSamplesDepend) {
  Scene s = scene(1, 60.0, 9);
  base::Random random(9, "noise");
  const auto e = slowNoise(random, s.evidence.rows(), 1e-3, 0.4, 1e-3);
  for (std::size_t i = 0; i < e.size(); ++i) s.evidence.q[0][i] += e[i];
  const Signature signature = signaturesIn(s).signatures.at("position of joint 1");
  std::size_t known = 0;
  for (const SignatureBin& bin : signature.bins) {
    if (std::isnan(bin.interval.low)) continue;
    ++known;
    const double naive = 2.0 * 1.96 * 1e-3 / std::sqrt(static_cast<double>(bin.samples));
    EXPECT_GT(bin.interval.high - bin.interval.low, 4.0 * naive);
  }
  EXPECT_GT(known, 15U);
}

TEST(Signature, OfCamerasIsTakenAtTheirOwnInstants) {
  Scene s = scene(2, 60.0, 31);
  for (double t = 0.0203; t < 59.9; t += 1.0 / 15.0) {
    const double row = t / 1e-3;
    const double q = Evidence::at(s.simulated.q[1], row);
    s.evidence.tip.push_back({t, row, {1e-3 * std::sin(4.0 * q), 0.0, 0.0}, true});
    s.simulated.tip.push_back(Eigen::Vector3d::Zero());
  }
  const Found found = signaturesIn(s, 2);
  EXPECT_GT(found.of("position of joint 2"), 0.97);
  EXPECT_LT(found.of("position of joint 1"), 0.3);
  EXPECT_EQ(found.signatures.count("motor angle of joint 1"), 0U);
}

}  // namespace
}  // namespace capstan::diagnosis
