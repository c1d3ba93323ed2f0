// For how many samples a residual counts.
#include "core/diagnosis/fit/cross_validation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "tests/support/folders.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

/// Inflation of x' = φ x + white noise over an axis' windows of 2 s, whose mean is taken off in each, so that
/// only its correlation can tell: mean of 20 draws.
double inflationOf(double phi) {
  test::DrawOptions options;
  options.robot = robot::readDescription(test::sourceFile("tests/support/planted/data/rigid_axis.yaml"));
  options.rigid = true;
  options.effects = 0;
  options.duration = 20.0;
  options.sensors.cameras = false;
  const std::vector<Evidence> evidence{evidenceOf(test::record(test::draw(5, options)).table, options.robot)};
  const FitData data(evidence, options.robot, 2.0, EncoderZeros::kKnown, 1);
  std::vector<std::vector<Eigen::Index>> rows(static_cast<std::size_t>(data.blocks()));
  for (std::size_t i = 0; i < data.block().size(); ++i)
    rows[static_cast<std::size_t>(data.block()[i])].push_back(static_cast<Eigen::Index>(i));
  base::Random random(3, "remainder");
  constexpr int kTimes = 20;
  double sum = 0.0;
  for (int time = 0; time < kTimes; ++time) {
    Eigen::VectorXd e(data.size());
    double x = 0.0;
    for (double& value : e) value = x = phi * x + random.normal();
    for (const auto& of_block : rows) e(of_block).array() -= e(of_block).mean();
    sum += squaresOf(data, e).inflation[0] / kTimes;
  }
  return sum;
}

TEST(BlockSquares, WhiteNoiseCountsWhole) { EXPECT_NEAR(inflationOf(0.0), 1.0, 0.15); }

/// 1 + 2 Σ φ^k = (1 + φ) / (1 − φ); of runs of 200 numbers whose mean is off somewhat less.
TEST(BlockSquares, ASmoothResidualCountsForAsFewAsItIs) {
  EXPECT_NEAR(inflationOf(0.5), 3.0, 0.5);
  EXPECT_NEAR(inflationOf(0.8), 9.0, 1.8);
}

/// What alternates is no worse known than white noise.
TEST(BlockSquares, NothingCountsForMoreThanItsNumbers) { EXPECT_NEAR(inflationOf(-0.5), 1.0, 1e-12); }

}  // namespace
}  // namespace capstan::diagnosis
