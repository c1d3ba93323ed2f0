// Numbers as people read them: units by hand calculation.
#include "core/diagnosis/report/shown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/robot/effects.h"

namespace capstan::diagnosis {
namespace {

TEST(ShownNumbers, AreInDegreesAndMillimetresWithTheDecimalsOfTheirSigma) {
  EXPECT_EQ(shownNumber(std::numbers::pi / 180.0, 0.0, "rad"), "1.00 deg");
  EXPECT_EQ(shownNumber(0.42e-3, 0.031e-3, "m"), "0.420 ± 0.031 mm");
  EXPECT_EQ(shownNumber(-0.0123, 0.00004, "m/s"), "−12.300 ± 0.040 mm/s");
  EXPECT_EQ(shownNumber(1234.6, 120.0, "N*m/rad"), "1230 ± 120 N·m/rad");
  EXPECT_EQ(shownNumber(-1e-4, 0.03, "rad"), "0.0 ± 1.7 deg") << "no −0.0";
  EXPECT_EQ(shownNumber(3e9, 0.0, "1/m^2"), "3.00·10⁹ 1/m²");
  EXPECT_EQ(shownNumber(std::numeric_limits<double>::quiet_NaN(), 1.0, "m"), "unknown");
}

TEST(ShownNumbers, AValueAndItsSigmaHaveOneFormat) {
  EXPECT_EQ(shownNumber(1.05e6, 153579.0, "N"), "(1.05 ± 0.15)·10⁶ N");
  EXPECT_EQ(shownNumber(929823.0, 15591.0, "N"), "930000 ± 16000 N") << "two digits of sigma, also if large";
  EXPECT_EQ(shownNumber(814287.0, 0.0, "N"), "814000 N");
  EXPECT_EQ(shownNumber(3.0, 2.5e6, "N"), "(0.0 ± 2.5)·10⁶ N") << "the exponent of the larger one";
  EXPECT_EQ(shownNumber(4.2e-7, 3.1e-8, "s"), "(4.20 ± 0.31)·10⁻⁷ s");
  EXPECT_EQ(shownNumber(-2.0e7, 1.0e6, "N/m"), "(−2.00 ± 0.10)·10⁷ N/m");
  EXPECT_EQ(shownNumber(9.96e6, 1e5, "N"), "(9.96 ± 0.10)·10⁶ N");
  EXPECT_EQ(shownNumber(1.0, 0.0996, "s"), "1.00 ± 0.10 s") << "two digits after rounding";
  EXPECT_EQ(shownNumber(999.6, 0.0, "N"), "1000 N") << "not 1000.0 or 999.6";
  EXPECT_EQ(shownNumber(9.999e6, 0.0, "N"), "1.00·10⁷ N");
  EXPECT_EQ(shownNumber(0.0, 0.0, "m"), "0 mm");
}

TEST(ShownNumbers, ParametersWithoutAUnitAreSharesUnlessTheyCount) {
  EXPECT_EQ(shownParameter("backlash", {"half_width", "m", 0.9e-3, 0.05e-3}), "half width 0.900 ± 0.050 mm");
  EXPECT_EQ(shownParameter("pulley_radius", {"share", "", 0.021, 0.0004}),
            "increase of the link radius 2.100 ± 0.040 %");
  EXPECT_EQ(shownParameter("backlash", {"half_width", "m", 0.9e-3, 0.0, 0.0, true}),
            "half width 0.900 mm (at its bound)");
  EXPECT_EQ(shownParameter("cable_coupling", {"other", "", 1.0, 0.0}), "other 1");
  EXPECT_EQ(shownParameter("sensor_sign", {"present", "", 1.0, 0.0}), "present 1");
}

// A play of 0.9 mm on a radius of 60 mm: 0.015 rad = 0.859 deg, by hand.
/// A number in per cent needs to say of what: "share" alone does not.
TEST(ShownNumbers, EveryShareSaysOfWhat) {
  for (const robot::EffectFacts& facts : robot::effectFacts())
    for (const robot::EffectParameter& parameter : facts.parameters) {
      const std::string shown =
          shownParameter(facts.name, {std::string(parameter.name), std::string(parameter.unit), 0.5, 0.0});
      if (!shown.ends_with("%")) continue;
      EXPECT_GE(std::ranges::count(shown, ' '), 4) << shown;
      EXPECT_FALSE(shown.starts_with("share ")) << shown;
    }
}

TEST(ShownNumbers, LengthsOfCableAreAlsoRotationsOfTheJoint) {
  EXPECT_EQ(shownParameter("backlash", {"half_width", "m", 0.9e-3, 0.05e-3, 1.0 / 0.06}),
            "half width 0.900 ± 0.050 mm of cable (0.859 ± 0.048 deg at the joint)");
}

TEST(ShownNumbers, JointZeroIsTheArmOrTheCameras) {
  EXPECT_EQ(shownJoint("backlash", 2), "joint 2");
  EXPECT_EQ(shownJoint("payload", 0), "whole arm");
  EXPECT_EQ(shownJoint("camera_latency", 0), "cameras");
}

TEST(ShownNumbers, SharesHaveWords) {
  EXPECT_EQ(shareWords(0.97), "nearly all of it");
  EXPECT_EQ(shareWords(0.5), "about half of it");
  EXPECT_EQ(shareWords(0.1), "a tenth of it");
  EXPECT_EQ(shareWords(-0.01), "no significant part of it");
}

}  // namespace
}  // namespace capstan::diagnosis
