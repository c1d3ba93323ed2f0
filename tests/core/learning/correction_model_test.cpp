// Corrections of an error that is known, and of nothing.
#include "core/learning/model/correction_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/learning/poses/rotation_vector.h"
#include "tests/core/learning/quick_options.h"

namespace capstan::learning {
namespace {

Eigen::Isometry3d pose(const Eigen::Vector3d& position, const Eigen::Vector3d& rotation_vector) {
  Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
  made.linear() = turnBy(rotation_vector).toRotationMatrix();
  made.translation() = position;
  return made;
}

/// What has to be told to see a pose: millimetres off by where it is, degrees by how fast it moves.
Eigen::Isometry3d toldFor(const Eigen::Isometry3d& observed, const Vector6d& velocity) {
  const Eigen::Vector3d p = observed.translation();
  const Eigen::Vector3d off(4e-3 * std::sin(40.0 * p.x()), 3e-3 * std::cos(30.0 * p.y()), 0.0);
  const Eigen::Isometry3d rigid = pose({0.02, 0.01, -0.03}, {0.2, 0.0, 0.1});
  Eigen::Isometry3d commanded =
      rigid * observed * pose(Eigen::Vector3d::Zero(), {0.5 * velocity[0], 0.0, 0.0});
  commanded.translation() += off;
  return commanded;
}

std::vector<State> states(std::size_t n, std::uint64_t seed, double noise = 1e-4) {
  base::Random random(seed, "states");
  const auto draw = [&](double size) -> Eigen::Vector3d {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
  };
  std::vector<State> made;
  while (made.size() < n) {
    State state;
    state.pair.observed = pose(draw(0.05), draw(0.3));
    state.velocity << draw(0.1), draw(0.5);
    state.pair.commanded = toldFor(state.pair.observed, state.velocity);
    state.pair.commanded.translation() += draw(noise);
    made.push_back(state);
  }
  return made;
}

CorrectionOptions quick() { return quickOptions(300); }

double rms(const CorrectionModel& model, const std::vector<State>& test) {
  const std::vector<Eigen::Isometry3d> commanded = model.correct(test);
  double squares = 0.0;
  for (std::size_t k = 0; k < test.size(); ++k)
    squares += squaredDistance(commanded[k], test[k].pair.commanded, kLever);
  return std::sqrt(squares / static_cast<double>(test.size()));
}

TEST(CorrectionModel, learnsWhatTheRigidOffsetLeaves) {
  const std::vector<State> train = states(800, 1), test = states(200, 2, 0.0);
  for (const RotationForm form : {RotationForm::kTangent, RotationForm::kYawPitchRoll}) {
    CorrectionOptions options = quick();
    options.rotation = form;
    const CorrectionModel model = CorrectionModel::trained(train, options);
    base::Progress cancelled;
    cancelled.cancel();
    const double rigid = rms(CorrectionModel::trained(train, options, &cancelled), test);
    EXPECT_GT(rigid, 2e-3);
    EXPECT_LT(rms(model, test), 0.1 * rigid) << base::nameOf(form);
  }
}

TEST(CorrectionModel, needsVelocitiesWhereErrorsDo) {
  const std::vector<State> train = states(800, 1), test = states(200, 2, 0.0);
  CorrectionOptions options = quick();
  const double with = rms(CorrectionModel::trained(train, options), test);
  options.motion = Motion::kNone;
  EXPECT_GT(rms(CorrectionModel::trained(train, options), test), 3.0 * with);
}

TEST(CorrectionModel, knowsHowSureItIs) {
  const CorrectionModel model = CorrectionModel::trained(states(800, 1), quick());
  int inside = 0, outputs = 0;
  for (const State& state : states(200, 3)) {
    const Corrected corrected = model.correct(state);
    EXPECT_GT(corrected.confidence, 0.5);
    const Eigen::Vector3d off = corrected.pose.translation() - state.pair.commanded.translation();
    for (int axis = 0; axis < 3; ++axis, ++outputs)
      inside += std::abs(off[axis]) < 2.0 * corrected.sigma[axis];
  }
  EXPECT_GT(inside, 0.9 * outputs);
}

/// Student's t of three degrees of freedom: two thirds within s leave a tenth beyond 2 s.
double heavyTailed(base::Random& random) {
  double squares = 0.0;
  for (int k = 0; k < 3; ++k) squares += std::pow(random.normal(), 2.0);
  return 5e-4 * random.normal() / std::sqrt(squares / 3.0);
}

/// Nineteen twentieths within 2 s leave half beyond s.
double even(base::Random& random) { return random.uniform(-1e-3, 1e-3); }

std::vector<State> withNoise(double (*noise)(base::Random&), std::uint64_t seed) {
  base::Random random(seed, "tails");
  std::vector<State> made = states(1200, seed, 0.0);
  for (State& state : made)
    for (Eigen::Index i = 0; i < 3; ++i) state.pair.commanded.translation()[i] += noise(random);
  return made;
}

/// Shares of positions' errors within one and two σ, of each axis.
std::array<Eigen::Array3d, 2> sharesStated(double (*noise)(base::Random&)) {
  const CorrectionModel model = CorrectionModel::trained(withNoise(noise, 1), quick());
  const std::vector<State> test = withNoise(noise, 2);
  const std::vector<Corrected> corrected = model.correctWithConfidence(test);
  std::array<Eigen::Array3d, 2> shares = {Eigen::Array3d::Zero(), Eigen::Array3d::Zero()};
  for (std::size_t k = 0; k < test.size(); ++k) {
    const Eigen::Array3d off = errorsInSigma(corrected[k], test[k].pair.commanded).head(3).array().abs();
    for (std::size_t sigmas : {1U, 2U})
      shares[sigmas - 1] += (off <= static_cast<double>(sigmas)).cast<double>();
  }
  for (Eigen::Array3d& share : shares) share /= static_cast<double>(test.size());
  return shares;
}

TEST(CorrectionModel, statesErrorsOfAnyTails) {
  const auto [heavy_one, heavy_two] = sharesStated(heavyTailed);
  EXPECT_GT(heavy_one.minCoeff(), kWithinSigma);
  EXPECT_LT((heavy_two - kWithinTwoSigma).abs().maxCoeff(), 0.02);
  const auto [even_one, even_two] = sharesStated(even);
  EXPECT_LT((even_one - kWithinSigma).abs().maxCoeff(), 0.04);
  EXPECT_GT(even_two.minCoeff(), kWithinTwoSigma);
}

TEST(CorrectionModel, fallsBackToTheRigidOffsetBeyondItsData) {
  const CorrectionModel model = CorrectionModel::trained(states(400, 1), quick());
  const Eigen::Isometry3d far = pose({5.0, 5.0, 5.0}, Eigen::Vector3d::Zero());
  const Corrected corrected = model.correct(far, Vector6d::Zero());
  EXPECT_LT(corrected.confidence, 1e-6);
  EXPECT_LT(squaredDistance(corrected.pose, model.offset() * far, kLever), 1e-16);
  const Eigen::Isometry3d rotated = pose(Eigen::Vector3d::Zero(), {1.5, 0.0, 0.0});
  EXPECT_LT(model.correct(rotated, Vector6d::Zero()).confidence, 1e-3) << "nobody has seen it turned so";
  double before = 1.0;  // and it gets there smoothly
  for (double x = 0.0; x < 0.5; x += 0.05) {
    const double confidence =
        model.correct(pose({x, 0.0, 0.0}, Eigen::Vector3d::Zero()), Vector6d::Zero()).confidence;
    EXPECT_LT(confidence, before + 0.05);
    before = confidence;
  }
  EXPECT_LT(before, 0.05);
}

TEST(CorrectionModel, learnsMoreWhileItRuns) {
  std::vector<State> train = states(800, 1);
  const std::vector<State> first(train.begin(), train.begin() + 300), more(train.begin() + 300, train.end());
  const std::vector<State> test = states(200, 2, 0.0);
  CorrectionModel model = CorrectionModel::trained(first, quick());
  const double before = rms(model, test);
  model.add(more);
  EXPECT_LT(rms(model, test), 0.9 * before);
}

TEST(CorrectionModel, refusesTooFew) {
  EXPECT_THROW(CorrectionModel::trained(states(kFewestStates - 1, 1)), base::InputError);
}

TEST(YawPitchRoll, leadsThereAndBack) {
  base::Random random(4, "angles");
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector3d angles(random.uniform(-3.1, 3.1), random.uniform(-1.57, 1.57),
                                 random.uniform(-3.1, 3.1));
    EXPECT_LT((yawPitchRoll(fromYawPitchRoll(angles)) - angles).norm(), 1e-6);
  }
  const Eigen::Matrix3d upright = fromYawPitchRoll({0.3, std::acos(-1.0) / 2.0, 0.0});
  EXPECT_LT((fromYawPitchRoll(yawPitchRoll(upright)) - upright).norm(), 1e-7);
}

TEST(MiddleTurn, liesInTheMiddle) {
  const Eigen::Vector3d v(0.4, -0.2, 0.6);
  const Eigen::Quaterniond middle = meanRotation(
      {pose(Eigen::Vector3d::Zero(), v + Eigen::Vector3d(0.1, 0, 0)), pose(Eigen::Vector3d::Zero(), v),
       pose(Eigen::Vector3d::Zero(), v - Eigen::Vector3d(0.1, 0, 0))});
  EXPECT_LT(rotationVector(middle.conjugate() * turnBy(v)).norm(), 1e-3);
  EXPECT_LT(rotationVector(meanRotation({})).norm(), 1e-12);
}

}  // namespace
}  // namespace capstan::learning
