// The Gaussian process of a residual: gradient, limits with a closed form, planted dependences.
#include "core/diagnosis/residuals/residual_process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/diagnosis/residuals/ard_process.h"
#include "tests/core/diagnosis/synthetic.h"

namespace capstan::diagnosis {
namespace {

ProcessInputs someInputs(Eigen::Index n, std::uint64_t seed) {
  base::Random random(seed, "inputs");
  ProcessInputs inputs;
  inputs.t.resize(n);
  inputs.x.resize(n, 3);
  inputs.angle = {false, true, false};
  for (Eigen::Index i = 0; i < n; ++i)
    inputs.t(i) = 0.1 * static_cast<double>(i), inputs.x.row(i) << random.normal(),
    random.uniform(0.0, 2.0 * std::numbers::pi), random.normal();
  return inputs;
}

Eigen::VectorXd someTargets(const ProcessInputs& inputs) {
  base::Random random(7, "targets");
  Eigen::VectorXd y(inputs.size());
  for (Eigen::Index i = 0; i < y.size(); ++i)
    y(i) = std::sin(inputs.x(i, 1)) + 0.5 * inputs.x(i, 0) + random.normal(0.0, 0.3);
  return (y.array() - y.mean()).matrix();
}

TEST(ArdProcess, GradientAgreesWithDifferences) {
  const ProcessInputs inputs = someInputs(40, 1);
  const ArdProcess process(inputs, someTargets(inputs));
  base::Random random(3, "parameters");
  for (int trial = 0; trial < 5; ++trial) {
    ProcessParameters at(7);
    for (Eigen::Index i = 0; i < 7; ++i) at(i) = random.uniform(-1.0, 1.5);
    Eigen::VectorXd gradient;
    ASSERT_TRUE(process.objective(at, &gradient).has_value());
    for (Eigen::Index i = 0; i < 7; ++i) {
      const double h = 1e-5;
      ProcessParameters more = at, less = at;
      more(i) += h, less(i) -= h;
      const double slope =
          (process.objective(more, nullptr).value() - process.objective(less, nullptr).value()) / (2.0 * h);
      EXPECT_NEAR(gradient(i), slope, 1e-6 * std::max(1.0, std::abs(slope))) << i;
    }
  }
}

/// With all points at one place and time K = (σ_f² + σ_c²) 1 1ᵀ + σ_n² I, whose inverse and determinant are
/// known.
TEST(ArdProcess, LikelihoodAgreesWithAClosedForm) {
  const Eigen::Index n = 12;
  ProcessInputs inputs;
  inputs.t = Eigen::VectorXd::Constant(n, 7.0);
  inputs.x = Eigen::MatrixXd::Constant(n, 1, 0.4);
  inputs.angle = {false};
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) y(i) = std::cos(3.0 * static_cast<double>(i)) + 0.2;
  const double f = 0.8, s = 0.5, c = 0.4, count = static_cast<double>(n);
  ProcessParameters at(5);
  at << std::log(f), std::log(s), std::log(c), std::log(0.3), std::log(4.0);
  const double shared = f * f + c * c, whole = s * s + count * shared;
  const double quadratic = (y.squaredNorm() - shared / whole * y.sum() * y.sum()) / (s * s);
  const double determinant = std::log(whole) + (count - 1.0) * std::log(s * s);
  const double prior =
      0.125 * (std::pow(std::log(f), 2) + std::pow(std::log(s / 0.3), 2) + std::pow(std::log(c / 0.3), 2));
  const double expected =
      0.5 * quadratic + 0.5 * determinant + 0.5 * count * std::log(2.0 * std::numbers::pi) + prior;
  const ArdProcess process(inputs, y);
  EXPECT_NEAR(process.objective(at, nullptr).value(), expected, 1e-9);
}

TEST(ArdProcess, FitLengthensWhatDoesNotMatter) {
  const ProcessInputs inputs = someInputs(200, 2);
  const ArdProcess process(inputs, someTargets(inputs));
  const ProcessParameters start = ProcessParameters::Zero(7);
  const ProcessParameters found = process.fit(start, 60, nullptr);
  EXPECT_LT(process.objective(found, nullptr).value(), process.objective(start, nullptr).value() - 10.0);
  EXPECT_GT(found(kLengths + 2), found(kLengths) + 1.0);
  EXPECT_GT(found(kLengths + 2), found(kLengths + 1) + 1.0);
  EXPECT_NEAR(std::hypot(std::exp(found(kWhite)), std::exp(found(kSlow))), 0.3, 0.06);
  Eigen::VectorXd gradient;
  process.objective(found, &gradient);
  EXPECT_LT(gradient.norm(), 1.0);
}

TEST(ArdProcess, AnglesHaveNoEnds) {
  EXPECT_NEAR(squaredDistance(0.01, 2.0 * std::numbers::pi - 0.01, true), 4.0 * std::pow(std::sin(0.01), 2),
              1e-12);
  EXPECT_EQ(squaredDistance(1.0, 3.0, false), 4.0);
}

/// Fewer points than by default keep the tests short.
ProcessOptions quick() {
  ProcessOptions options;
  options.points = 400;
  options.iterations = 25;
  return options;
}

struct Planted {
  ResidualProcess process;
  double share = 0.0;  ///< of the effect in the residual's variance
};

Planted plant(Scene s, double noise, const std::function<double(const Scene&, std::size_t)>& effect,
              const ProcessOptions& options = quick()) {
  base::Random random(5, "noise");
  std::vector<double> added;
  for (std::size_t i = 0; i < s.evidence.rows(); ++i) added.push_back(effect(s, i));
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < added.size(); ++i) {
    s.evidence.q[0][i] += added[i] + random.normal(0.0, noise);
    sum += added[i], squares += added[i] * added[i];
  }
  const auto n = static_cast<double>(added.size());
  const double variance = squares / n - sum / n * sum / n;
  const auto channels = residualOf(s.evidence, s.simulated, s.robot);
  return {residualProcess(channels[0], variablesOf(s.evidence, s.simulated, s.robot), options),
          variance / (variance + noise * noise)};
}

TEST(ResidualProcess, FindsAPositionAndNothingElse) {
  const auto [process, share] = plant(scene(2, 60.0, 41, 4e-3), 1e-3, [](const Scene& s, std::size_t i) {
    return 3e-3 * std::sin(4.0 * s.simulated.q[1][i]);
  });
  ASSERT_EQ(process.end, ProcessEnd::kDone);
  EXPECT_GT(share, 0.6);
  ASSERT_FALSE(process.variables.empty());
  EXPECT_EQ(process.variables[0].name, "position of joint 2");
  EXPECT_NEAR(process.variables[0].relevance, share, 0.15);
  for (std::size_t v = 1; v < process.variables.size(); ++v)
    EXPECT_NEAR(process.variables[v].relevance, 0.0, 0.04) << process.variables[v].name;
  EXPECT_NEAR(process.explained, share, 0.1);
  EXPECT_NEAR(process.noise, 1e-3, 2e-4);
  EXPECT_TRUE(process.words.starts_with("depends on position of joint 2, strongly")) << process.words;
}

/// What two variables do together has no share of either alone: signatures are blind to it.
TEST(ResidualProcess, FindsTwoVariablesThatActTogether) {
  const auto [process, share] = plant(scene(2, 60.0, 43, 4e-3), 5e-4, [](const Scene& s, std::size_t i) {
    return 6e-3 * s.simulated.q[0][i] * s.simulated.q[1][i];
  });
  ASSERT_EQ(process.end, ProcessEnd::kDone);
  std::vector<std::string> first = {process.variables[0].name, process.variables[1].name};
  std::sort(first.begin(), first.end());
  EXPECT_EQ(first, (std::vector<std::string>{"position of joint 1", "position of joint 2"}));
  EXPECT_GT(process.variables[1].relevance, kClearly);
  EXPECT_LT(process.variables[2].relevance, 0.5 * process.variables[1].relevance);
  EXPECT_GT(process.explained, 0.7 * share);
}

TEST(ResidualProcess, FindsTheMotorAngle) {
  const auto [process, share] = plant(scene(2, 60.0, 44, 4e-3), 1e-3, [](const Scene& s, std::size_t i) {
    return 2e-3 * std::sin(s.evidence.q_m[0][i] + 1.0);
  });
  ASSERT_EQ(process.end, ProcessEnd::kDone);
  EXPECT_EQ(process.variables[0].name, "motor angle of joint 1");
  EXPECT_NEAR(process.variables[0].relevance, share, 0.15);
}

TEST(ResidualProcess, SaysThatNoiseDependsOnNothing) {
  for (const double memory : {1e-6, 0.2, 0.5}) {
    Scene s = scene(2, 60.0, 45, 4e-3);
    base::Random random(6, "noise");
    const auto e = slowNoise(random, s.evidence.rows(), 4e-3, memory, 1e-3);
    for (std::size_t i = 0; i < e.size(); ++i) s.evidence.q[0][i] += e[i];
    const auto channels = residualOf(s.evidence, s.simulated, s.robot);
    const ResidualProcess process =
        residualProcess(channels[0], variablesOf(s.evidence, s.simulated, s.robot), quick());
    ASSERT_EQ(process.end, ProcessEnd::kDone);
    for (const ProcessVariable& variable : process.variables)
      EXPECT_NEAR(variable.relevance, 0.0, 0.05) << variable.name << ", memory " << memory;
    EXPECT_LT(process.explained, 0.05);
    EXPECT_EQ(process.words, "depends on none of the variables");
  }
}

TEST(ResidualProcess, SameSeedSameAnswer) {
  const auto effect = [](const Scene& s, std::size_t i) { return 2e-3 * s.simulated.q[0][i]; };
  const Planted one = plant(scene(1, 20.0, 46, 4e-3), 1e-3, effect, quick());
  const Planted two = plant(scene(1, 20.0, 46, 4e-3), 1e-3, effect, quick());
  for (std::size_t v = 0; v < one.process.variables.size(); ++v)
    EXPECT_EQ(one.process.variables[v].relevance, two.process.variables[v].relevance);
}

TEST(ResidualProcess, SaysWhenThereIsTooLittle) {
  Scene s = scene(1, 0.15, 1, 4e-3);
  const auto channels = residualOf(s.evidence, s.simulated, s.robot);
  EXPECT_EQ(residualProcess(channels[0], variablesOf(s.evidence, s.simulated, s.robot)).end,
            ProcessEnd::kTooFew);
  s = scene(1, 10.0, 1, 4e-3);  // the residual never changes
  const auto flat = residualOf(s.evidence, s.simulated, s.robot);
  EXPECT_EQ(residualProcess(flat[0], variablesOf(s.evidence, s.simulated, s.robot)).end, ProcessEnd::kTooFew);
}

TEST(ResidualProcess, Cancels) {
  Scene s = scene(1, 20.0, 46, 4e-3);
  for (std::size_t i = 0; i < s.evidence.rows(); ++i) s.evidence.q[0][i] += 1e-3 * s.simulated.q[0][i];
  const auto channels = residualOf(s.evidence, s.simulated, s.robot);
  base::Progress progress;
  progress.cancel();
  EXPECT_EQ(residualProcess(channels[0], variablesOf(s.evidence, s.simulated, s.robot), {}, &progress).end,
            ProcessEnd::kCancelled);
}

}  // namespace
}  // namespace capstan::diagnosis
