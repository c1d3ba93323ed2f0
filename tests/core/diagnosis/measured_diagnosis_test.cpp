// What a diagnosis names in recordings of real robots, where they are on this machine; measured_diagnosis
// (tests/benchmarks) prints the numbers.
#include <gtest/gtest.h>

#include "tests/support/measured_diagnosis/emps.h"
#include "tests/support/measured_diagnosis/jaw.h"
#include "tests/support/measured_diagnosis/steps.h"

namespace capstan::measured {
namespace {

#define REQUIRE_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is not on this machine"

/// Black-box models of the benchmark reach 5.2 to 5.5 mm on the record that nothing was fitted to.
TEST(MeasuredDiagnosis, AxisOfThePublicBenchmark) {
  const std::filesystem::path folder = dataFolder() / "emps";
  REQUIRE_DATA(folder / "train.csv");
  const std::vector<EmpsStep> steps = empsSteps(folder, 2);
  ASSERT_GE(steps.size(), 2U);
  EXPECT_EQ(steps[1].name, "+ asymmetric_viscosity");
  EXPECT_GT(steps.front().test_mm, 20.0) << "the nominal structure drifts away";
  EXPECT_LT(steps.back().train_mm, 3.5);
  EXPECT_LT(steps.back().test_mm, 4.5);
}

TEST(MeasuredDiagnosis, JawOfAnInstrument) {
  const std::filesystem::path folder = dataFolder() / "davinci-jaw";
  REQUIRE_DATA(folder);
  const std::vector<JawStep> steps = jawSteps(folder, {"0.1", "0.3"}, 2);
  EXPECT_NEAR(steps.front().zero_once_deg, 2.88, 0.15) << "a gear ratio alone, as others found";
  EXPECT_NEAR(steps.front().zero_each_deg, 1.15, 0.1);
  ASSERT_GE(steps.size(), 3U);
  EXPECT_EQ(steps[1].name, "+ viscous_friction") << "friction behind a cable that gives";
  EXPECT_LT(steps.back().zero_each_deg, 0.7);
  EXPECT_LT(steps.back().zero_each_deg, 0.6 * steps.front().zero_each_deg);
}

}  // namespace
}  // namespace capstan::measured
