// Which parameters an identification leaves at their values, and why, in sentences.
#include "core/identification/estimate_text.h"

#include <gtest/gtest.h>

namespace capstan::identification {
namespace {

Estimate estimateOf(Quantity quantity, int joint, Weakness weakness = Weakness::kNone) {
  Estimate estimate;
  estimate.parameter.quantity = quantity;
  estimate.parameter.joint = joint;
  estimate.seen = weakness == Weakness::kNone;
  estimate.weakness = weakness;
  return estimate;
}

TEST(EstimateText, NamesWhatIsTakenAndWhyTheOthersStay) {
  const std::vector<Estimate> estimates = {estimateOf(Quantity::kLinkRadius, 0),
                                           estimateOf(Quantity::kLinkRadius, 1),
                                           estimateOf(Quantity::kStiffness, 0, Weakness::kHidden),
                                           estimateOf(Quantity::kDamping, 0, Weakness::kSmallEffect),
                                           estimateOf(Quantity::kFriction, 0, Weakness::kSmallEffect),
                                           estimateOf(Quantity::kFriction, 2, Weakness::kCorrelated)};
  EXPECT_EQ(
      identifiedText(estimates),
      "The values of r_l1 and r_l2 are identified. The other parameters keep their values: b_e1 and f_c1 "
      "have too small an effect in this motion; f_c3 cannot be distinguished from another unknown in this "
      "motion; k_e1 is hidden by friction and hysteresis that the model does not contain.");
  EXPECT_EQ(acceptText(estimates),
            "Accept takes 2 of 6 values: r_l1 and r_l2. The others keep their values.");
}

TEST(EstimateText, SaysThatAllOrNoneIsObservable) {
  const std::vector<Estimate> all = {estimateOf(Quantity::kStiffness, 1)};
  EXPECT_EQ(identifiedText(all), "The value of k_e2 is identified.");
  EXPECT_EQ(keptText(all), "");
  EXPECT_EQ(acceptText(all), "Accept takes k_e2.");
  const std::vector<Estimate> none = {estimateOf(Quantity::kDamping, 1, Weakness::kNoBetter)};
  EXPECT_EQ(identifiedText(none),
            "No parameter is observable in this motion. All parameters keep their values: b_e2 is known no "
            "better than before the recording.");
  EXPECT_EQ(acceptText(none).find("No parameter is observable so far, so there is nothing to accept."), 0U);
}

}  // namespace
}  // namespace capstan::identification
