#include "core/tracking/cable_arm_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/estimation/consistency.h"
#include "core/estimation/square_root_ukf.h"
#include "tests/core/tracking/cable_arm_scene.h"
#include "tests/support/cable_arm_reference.h"
#include "tests/support/counting_new.h"
#include "tests/support/folders.h"
#include "tests/support/ukf_reference.h"

namespace capstan::tracking {
namespace {

using math::InstructionSet;
using Real = long double;
using Reference = capstan::test::CableArmReference<Real>;
using RealState = Reference::State;

Reference::Motor real(const MotorState& m) { return {m.position.cast<Real>(), m.velocity.cast<Real>()}; }

class CableArmKernels : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!math::isAvailable(GetParam())) GTEST_SKIP() << "this processor lacks " << math::nameOf(GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, CableArmKernels, testing::ValuesIn(math::kInstructionSets));

TEST_P(CableArmKernels, ElementaryFunctionsAreGoodToTheLastBits) {
  base::Random random(20);
  alignas(64) double x[16], sine[16], cosine[16], tangent[16], sinh[16];
  double worst[4] = {};
  const auto note = [](double& most, double got, Real expected) {
    if (expected == 0.0L) {
      EXPECT_EQ(got, 0.0);
      return;
    }
    most = std::max(most, static_cast<double>(std::abs((Real(got) - expected) / expected)));
  };
  for (int trial = 0; trial < 20000; ++trial) {
    const double scale = std::pow(10.0, random.uniform(-300.0, 2.5));
    const double common = trial % 2 == 0 ? scale : std::min(scale, 0.1);  // both branches of 2 sinh
    for (double& value : x) value = random.normal(0.0, trial % 3 == 0 ? 1.0 : common);
    x[3] = 0.0;
    x[7] = M_PI_2 * std::round(random.uniform(-50.0, 50.0));  // near the zeros of sine and cosine
    cableArmKernel(GetParam()).elementary(x, sine, cosine, tangent, sinh);
    for (int i = 0; i < 16; ++i) {
      const Real value = x[i];
      note(worst[0], sine[i], std::sin(value));
      note(worst[1], cosine[i], std::cos(value));
      note(worst[2], tangent[i], std::tanh(value));
      if (std::abs(value) < 700.0L) note(worst[3], sinh[i], 2.0L * std::sinh(value));
    }
  }
  std::printf("%s: relative error sin %.2g, cos %.2g, tanh %.2g, 2 sinh %.2g\n", math::nameOf(GetParam()),
              worst[0], worst[1], worst[2], worst[3]);
  for (const double error : worst) EXPECT_LT(error, 1e-13);
}

TEST_P(CableArmKernels, PropagationAgreesWithTheReference) {
  base::Random random(21);
  const CableArmModel model(raven(), GetParam());
  const Reference reference(raven());
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    const test::ArmMoment now = test::randomMoment(random);
    const double dt = random.uniform(2e-4, 2e-3);
    const auto next = model.propagateOne(now.x, CableArmModel::interval(now.begin, now.end), dt);
    const RealState expected =
        reference.propagate(now.x.cast<Real>(), real(now.begin), real(now.end), Real(dt), model.stepsFor(dt));
    for (int i = 0; i < 6; ++i)
      worst = std::max(
          worst, std::abs(next(i) - static_cast<double>(expected(i))) / std::max(1.0, std::abs(next(i))));
  }
  EXPECT_LT(worst, 1e-12);
}

TEST_P(CableArmKernels, EveryLaneIsTheSame) {
  base::Random random(22);
  const CableArmModel model(raven(), GetParam());
  const test::ArmMoment now = test::randomMoment(random);
  alignas(64) CableArmModel::Points points;
  points.colwise() = now.x;
  model.propagate(points, CableArmModel::interval(now.begin, now.end), 1e-3);
  for (int c = 1; c < points.cols(); ++c) EXPECT_EQ(points.col(c), points.col(0));
}

TEST_P(CableArmKernels, BoxHoldsWildPointsAndNaNIsNotHidden) {
  const CableArmModel model(raven(), GetParam());
  const auto& c = model.constants();
  base::Random random(23);
  alignas(64) CableArmModel::Points points;
  for (int trial = 0; trial < 200; ++trial) {
    const double scale = std::pow(10.0, random.uniform(0.0, 300.0));
    for (int i = 0; i < points.size(); ++i) points.data()[i] = random.normal(0.0, scale);
    points(0, 0) = std::numeric_limits<double>::infinity();
    model.propagate(points, {}, 1e-3);
    ASSERT_TRUE(points.allFinite()) << scale;
    for (int i = 0; i < 6; ++i) {
      EXPECT_GE(points.row(i).minCoeff(), c.low[i]);
      EXPECT_LE(points.row(i).maxCoeff(), c.high[i]);
    }
  }
  points.setZero();
  points(2, 5) = std::numeric_limits<double>::quiet_NaN();
  model.propagate(points, {}, 1e-3);
  EXPECT_TRUE(std::isnan(points(2, 5)));
  EXPECT_TRUE(points.col(4).allFinite());
}

TEST(CableArmReference, AgreesWithTheIndependentTable) {
  const std::filesystem::path table = capstan::test::sharedFile("raven2-check.csv");
  REQUIRE_DATA(table);
  std::ifstream file(table);
  const Reference reference(raven());
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    Eigen::Matrix<double, 18, 1> v;
    for (int i = 0; i < 18; ++i) in >> v(i);
    const Eigen::Matrix<Real, 18, 1> r = v.cast<Real>();
    const Reference::Vector3 tau = reference.inverse(r.segment<3>(0), r.segment<3>(3), r.segment<3>(6));
    const Reference::Matrix3 m = reference.massMatrix(r.segment<3>(0));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(static_cast<double>(tau(i)), v(9 + i), 1e-9 * std::max(1.0, std::abs(v(9 + i))));
    const double expected[] = {v(12), v(13), v(14), v(15), v(16), v(17)};
    const Real got[] = {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(static_cast<double>(got[i]), expected[i], 1e-9);
    ++rows;
  }
  EXPECT_EQ(rows, 200);
}

TEST(CableArmModel, RateBoundsTheMeasuredEigenvalues) {
  const double rate = cableArmRate(raven());
  const Reference reference(raven());
  base::Random random(24);
  double largest = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    test::ArmMoment now = test::randomMoment(random);
    for (const int i : {1, 3, 5}) now.x(i) = 0.0;  // steepest friction
    Eigen::Matrix<double, 6, 6> jacobian;
    for (int j = 0; j < 6; ++j) {
      RealState high = now.x.cast<Real>(), low = high;
      high(j) += 1e-7L;
      low(j) -= 1e-7L;
      jacobian.col(j) =
          ((reference.derivative(high, real(now.begin)) - reference.derivative(low, real(now.begin))) / 2e-7L)
              .cast<double>();
    }
    largest = std::max(largest, jacobian.eigenvalues().cwiseAbs().maxCoeff());
  }
  EXPECT_LE(largest, 1.01 * rate);
  EXPECT_GE(largest, 0.7 * rate);  // a bound that is not idle
  const CableArmModel model(raven());
  for (const double dt : {1e-5, 1e-3, 5e-3}) EXPECT_LE(rate * dt / model.stepsFor(dt), 2.0);
  EXPECT_EQ(model.stepsFor(0.0), 1);
}

TEST(CableArmModel, ParametersCanBeChangedAtRunTime) {
  robot::Description robot = raven();
  CableArmModel model(robot);
  robot.drives[0].link_radius = 0.059;
  robot.drives[1].cable_stiffness *= 0.5;
  robot.drives[2].cable_damping *= 2.0;
  const CableArmModel other(robot);
  model.setConstants(cableArmConstants(robot), cableArmRate(robot));
  base::Random random(25);
  const test::ArmMoment now = test::randomMoment(random);
  const auto input = CableArmModel::interval(now.begin, now.end);
  EXPECT_EQ(model.propagateOne(now.x, input, 1e-3), other.propagateOne(now.x, input, 1e-3));
  EXPECT_NE(model.propagateOne(now.x, input, 1e-3), CableArmModel(raven()).propagateOne(now.x, input, 1e-3));
}

}  // namespace
}  // namespace capstan::tracking
