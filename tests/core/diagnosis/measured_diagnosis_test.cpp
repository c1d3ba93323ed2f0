// What a diagnosis names in recordings of real robots, where they are on this machine; measured_diagnosis
// (tests/benchmarks) prints the numbers.
#include <gtest/gtest.h>

#include "tests/support/folders.h"
#include "tests/support/measured_diagnosis/emps.h"
#include "tests/support/measured_diagnosis/jaw.h"
#include "tests/support/measured_diagnosis/steps.h"

namespace capstan::measured {
namespace {

/// A four-number drive of others leaves 9.4 mm on the record that nothing was fitted to, black boxes 5.2 to
/// 5.5.
TEST(MeasuredDiagnosis, AxisOfThePublicBenchmark) {
  const std::filesystem::path folder = test::dataFolder() / "emps";
  REQUIRE_DATA(folder / "train.csv");
  REQUIRE_DATA(folder / "test.csv");
  const std::vector<EmpsStep> steps = empsSteps(folder, EmpsStart::kFourNumbers, 2);
  EXPECT_GT(steps.front().whole_test.at_rest, 7.0) << "the drive of four numbers";
  EXPECT_LT(steps.front().whole_test.at_rest, 9.4);
  ASSERT_GE(steps.size(), 2U);
  EXPECT_EQ(steps[1].name, "+ asymmetric_viscosity");
  EXPECT_LT(steps[1].whole_train.at_rest, steps[0].whole_train.at_rest);
  EXPECT_LE(steps[1].whole_test.at_rest, 4.0);
  EXPECT_LT(steps[1].whole_test.moving, 0.85 * steps[0].whole_test.moving);
  for (std::size_t k = 1; k < steps.size();
       ++k)  // in the order of what is lost without each, on training data
    EXPECT_LT(steps[k].test.at_rest, steps[k - 1].test.at_rest) << steps[k].name;
  EXPECT_LT(steps.back().test.at_rest, 5.2) << "the best black box";
}

/// The first two effects that measured_diagnosis finds, from fewer refits, for time. At one frequency alone
/// friction that grows with speed, behind a stiff cable, explains the lag as well.
TEST(MeasuredDiagnosis, JawOfAnInstrument) {
  const std::filesystem::path folder = test::dataFolder() / "davinci-jaw";
  REQUIRE_DATA(folder);
  diagnosis::SearchOptions options;
  options.most_causes = 2;
  options.refits = 4;
  const Jaw jaw(folder, {"0.1", "0.3"}, 2);
  const std::vector<JawStep> steps = jaw.steps(jaw.select(options));
  EXPECT_NEAR(steps.front().errors.odd, 2.88, 0.15) << "a gear ratio alone, as others found";
  ASSERT_GE(steps.size(), 2U);
  EXPECT_EQ(steps[1].name, "+ cable_compliance");
  EXPECT_LT(steps[1].errors.odd, 1.73) << "a linear stretch, as others found";
  EXPECT_LT(steps.back().errors.odd, 1.1);
}

}  // namespace
}  // namespace capstan::measured
