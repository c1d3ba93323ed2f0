// For how many samples a remainder counts.
#include "core/diagnosis/cross_validation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/diagnosis/read_evidence.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

/// Inflation of x' = φ x + white noise over an axis' windows of 2 s.
double inflationOf(double phi) {
  test::DrawOptions options;
  options.robot = robot::readDescription(std::filesystem::path(CAPSTAN_SOURCE_DIR) /
                                         "tests/support/planted/data/rigid_axis.yaml");
  options.rigid = true;
  options.effects = 0;
  options.duration = 20.0;
  options.sensors.cameras = false;
  EvidenceOptions read;
  read.drive = DriveKind::kRigid;
  const std::vector<Evidence> evidence{
      evidenceOf(test::record(test::draw(5, options)).table, options.robot, read)};
  const FitData data(evidence, options.robot, 2.0, EncoderZeros::kKnown, 1);
  base::Random random(3, "remainder");
  Eigen::VectorXd e(data.size());
  double x = 0.0;
  for (double& value : e) value = x = phi * x + random.normal();
  return squaresOf(data, e).inflation[0];
}

TEST(BlockSquares, WhiteNoiseCountsWhole) { EXPECT_NEAR(inflationOf(0.0), 1.0, 0.3); }

/// 1 + 2 Σ φ^k = (1 + φ) / (1 − φ), Geyer's sum a little short of it on runs of 200.
TEST(BlockSquares, ASmoothRemainderCountsForAsFewAsItIs) {
  EXPECT_NEAR(inflationOf(0.8), 9.0, 2.5);
  EXPECT_NEAR(inflationOf(0.95), 39.0, 15.0);
}

/// What alternates is no worse known than white noise.
TEST(BlockSquares, NothingCountsForMoreThanItsNumbers) { EXPECT_EQ(inflationOf(-0.5), 1.0); }

}  // namespace
}  // namespace capstan::diagnosis
