#include "core/tracking/transmission_text.h"

#include <gtest/gtest.h>

namespace capstan::tracking {
namespace {

using Lines = std::vector<std::string>;

TEST(TransmissionText, NothingIsSaidOfARobotThatIsRight) {
  const TransmissionEstimate nothing;
  EXPECT_TRUE(linesOf(nothing).empty());
  EXPECT_TRUE(remediesOf(nothing).empty());
  EXPECT_TRUE(shortTextOf(nothing).empty());
}

TEST(TransmissionText, EachKindOfErrorHasItsRemedy) {
  TransmissionEstimate pulley;
  pulley.scale(0) = 0.0697;
  pulley.scale_sigma(0) = 0.001;
  EXPECT_EQ(linesOf(pulley), Lines{"joint 1: cable travel +6.97 ± 0.10 % of nominal (pulley radius)"});
  EXPECT_EQ(remediesOf(pulley), Lines{"A constant of the robot file is wrong: identify it."});

  TransmissionEstimate homing;
  homing.offset(2) = -2.06e-3;
  homing.offset_sigma(2) = 0.09e-3;
  EXPECT_EQ(linesOf(homing), Lines{"joint 3: cable zero −2.06 ± 0.09 mm off (homing)"});
  ASSERT_EQ(remediesOf(homing).size(), 1U);
  EXPECT_NE(remediesOf(homing)[0].find("home the arm again"), std::string::npos);

  TransmissionEstimate soft;
  soft.compliance(1) = 0.5;
  EXPECT_EQ(linesOf(soft), Lines{"joint 2: cable stiffness 2 times that of the robot file"});
  EXPECT_EQ(remediesOf(soft), remediesOf(pulley));

  TransmissionEstimate moved;
  moved.camera_moved_probability = 0.9;
  moved.camera_shift.x() = 12.1e-3;
  EXPECT_EQ(linesOf(moved), Lines{"cameras moved since their registration: 0.00°, 12.1 mm"});
  EXPECT_EQ(remediesOf(moved), Lines{"The cameras are not where they were registered: register them again."});
  moved.camera_scale = 0.04;
  EXPECT_NE(linesOf(moved)[0].find("scale +4.0 % (base line or focal length)"), std::string::npos);

  TransmissionEstimate late;
  late.camera_delay = 0.06;
  EXPECT_EQ(linesOf(late), Lines{"camera stamps 60 ms late"});
  EXPECT_EQ(remediesOf(late),
            Lines{"The camera's time stamps are off: raise camera_delay in the filter options by 0.060 s."});
  late.camera_delay = -0.1;
  EXPECT_EQ(remediesOf(late, DelayField::kLiveSetup),
            Lines{"The camera's time stamps are off: reduce cameras.latency in the live set-up by 0.100 s."});
}

TEST(TransmissionText, AChangeInQuestionIsNamedWithoutACause) {
  TransmissionEstimate changed;
  changed.change_in_question = true;
  ASSERT_EQ(linesOf(changed).size(), 1U);
  EXPECT_NE(linesOf(changed)[0].find("no longer agree"), std::string::npos);
  EXPECT_EQ(shortTextOf(changed), "cameras or encoders changed");
}

}  // namespace
}  // namespace capstan::tracking
