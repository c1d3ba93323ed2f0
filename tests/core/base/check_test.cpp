// Invariants fire in the build that the tests use.
#include "core/base/check.h"

#include <gtest/gtest.h>

#include <array>

#include "core/robot/transmission.h"
#include "core/stats/quantile.h"

namespace capstan::base {
namespace {

TEST(CheckDeathTest, ABrokenInvariantNamesConditionAndPlace) {
  const int joints = 0;
  EXPECT_DEATH(CAPSTAN_CHECK(joints > 0), "tests/core/base/check_test.cpp:[0-9]+: TestBody: joints > 0");
  EXPECT_DEATH(CAPSTAN_ASSERT(joints > 0), "joints > 0 does not hold");
}

TEST(Check, ThatHoldsDoesNothingAndIsEvaluatedOnce) {
  int calls = 0;
  CAPSTAN_CHECK(++calls > 0);
  EXPECT_EQ(calls, 1);
}

/// Of the libraries that the programs link: they were built with their invariants on.
TEST(CheckDeathTest, TheLibrariesInvariantsAreOn) {
  EXPECT_DEATH(robot::Transmission(robot::Description{}), "core/robot/transmission.cpp");
  constexpr std::array kBeyond = {1.5};
  EXPECT_DEATH(stats::quantiles(std::vector<double>{1.0, 2.0}, kBeyond), "core/stats/quantile.cpp");
}

}  // namespace
}  // namespace capstan::base
