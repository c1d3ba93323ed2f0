#include "core/estimation/nis_verdict.h"

#include <gtest/gtest.h>

#include "core/estimation/consistency.h"

namespace capstan::estimation {
namespace {

TEST(NisVerdict, TooLowIsCautiousAndOnlyTooHighFails) {
  const Band band = chiSquareBand(3, 150);
  const auto judged = [&](double mean) { return judgeNis(mean, band.contains(mean)); };
  EXPECT_EQ(judged(0.13), NisVerdict::kCautious);
  EXPECT_EQ(judged(1.02), NisVerdict::kPass);
  EXPECT_EQ(judged(8.2), NisVerdict::kTooHigh);
  EXPECT_EQ(base::nameOf(NisVerdict::kCautious), "cautious");
  EXPECT_EQ(base::nameOf(NisVerdict::kTooHigh), "FAIL, too high");
}

TEST(NisVerdict, TheBandHolds1ForEveryCount) {
  for (const int count : {1, 2, 3, 10, 150, 100000})
    EXPECT_TRUE(chiSquareBand(3, count).contains(1.0)) << count;
}

TEST(NisVerdict, AFailureNamesTheRemedyAndCautionNamesNone) {
  EXPECT_NE(adviceOf(NisVerdict::kTooHigh).find("identify"), std::string_view::npos);
  EXPECT_EQ(adviceOf(NisVerdict::kCautious).find("identify"), std::string_view::npos);
  EXPECT_TRUE(adviceOf(NisVerdict::kPass).empty());
}

}  // namespace
}  // namespace capstan::estimation
