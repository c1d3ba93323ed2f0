// What the identify command says of parameters that are not observable.
#include "app/cli/identify_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace capstan::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string saidOf(const std::string& by_dual, const std::string& by_batch) {
  identification::DualUkfReport dual;
  dual.estimates.resize(1);
  dual.estimates[0].advice = by_dual;
  dual.convergence.resize(1);
  identification::BatchReport batch;
  batch.estimates = dual.estimates;
  batch.estimates[0].advice = by_batch;
  return textOf(&dual, &batch, {});
}

TEST(IdentifyOutput, WhyItIsNotSeenIsSaidOnceWhereBothMethodsSayTheSame) {
  const std::string text = saidOf("known to 12 % only; move faster", "known to 9.5 % only; move faster");
  EXPECT_THAT(text, HasSubstr("known to 12 % only"));
  EXPECT_THAT(text, HasSubstr("not observable, as above"));
  EXPECT_THAT(text, Not(HasSubstr("9.5")));
}

TEST(IdentifyOutput, AnotherReasonIsSaidToo) {
  const std::string text =
      saidOf("known to 12 % only; move faster", "cannot be told from joint 2's damping (correlation 0.97)");
  EXPECT_THAT(text, HasSubstr("known to 12 % only"));
  EXPECT_THAT(text, HasSubstr("cannot be told from joint 2's damping"));
  EXPECT_THAT(text, Not(HasSubstr("as above")));
}

}  // namespace
}  // namespace capstan::cli
