// Displacements from which on an effect is material: their text, and what is compared with them.
#include "core/diagnosis/report/tolerance.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/diagnosis/selection/displacement.h"
#include "core/diagnosis/selection/explainable.h"

namespace capstan::diagnosis {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Tolerance, IsParsedInAnyOrderAndUnit) {
  const Tolerance both = parseTolerance("0.05deg,20um", "--material");
  EXPECT_NEAR(both.angle, 0.05 * kDegree, 1e-15);
  EXPECT_NEAR(both.length, 2e-5, 1e-18);
  const Tolerance turned = parseTolerance("0.3mm,1e-3rad", "--material");
  EXPECT_NEAR(turned.angle, 1e-3, 1e-15);
  EXPECT_NEAR(turned.length, 3e-4, 1e-17);
  EXPECT_NEAR(parseTolerance("0.002m", "--material").length, 0.002, 1e-15);
}

TEST(Tolerance, WhatIsNotGivenKeepsItsDefault) {
  EXPECT_EQ(parseTolerance("1deg", "--material").length, Tolerance{}.length);
  EXPECT_EQ(parseTolerance("1mm", "--material").angle, Tolerance{}.angle);
  EXPECT_NEAR(Tolerance{}.angle, 0.02 * kDegree, 1e-15);
  EXPECT_NEAR(Tolerance{}.length, 2e-5, 1e-18);
}

TEST(Tolerance, IsFormattedAsItIsParsed) {
  EXPECT_EQ(formatTolerance({}), "0.02deg,0.02mm");
  EXPECT_EQ(formatTolerance({1.5 * kDegree, 2.5e-3}), "1.5deg,2.5mm");
  const Tolerance again = parseTolerance(formatTolerance({0.125 * kDegree, 3e-6}), "--material");
  EXPECT_NEAR(again.angle, 0.125 * kDegree, 1e-9);
  EXPECT_NEAR(again.length, 3e-6, 1e-12);
}

TEST(Tolerance, RefusesAnythingElseWithValueOptionAndRemedy) {
  const std::pair<const char*, const char*> refused[] = {// text, the part that is at fault
                                                         {"", ""},
                                                         {"small", "small"},
                                                         {"0.02", "0.02"},
                                                         {"0.02deg,0.01", "0.01"},
                                                         {"0.02deg,", ""},
                                                         {"0.02 deg", "0.02 deg"},
                                                         {"0.02inch,1mm", "0.02inch"},
                                                         {"-1deg", "-1deg"},
                                                         {"1deg,0mm", "0mm"},
                                                         {"1deg,2rad", "2rad"},
                                                         {"nandeg", "nandeg"},
                                                         {"infmm", "infmm"}};
  for (const auto& [text, part] : refused) {
    try {
      parseTolerance(text, "--material");
      ADD_FAILURE() << '"' << text << "\" was accepted";
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().key, "--material") << text;
      EXPECT_EQ(error.fault().value, part) << text;
      EXPECT_FALSE(error.fault().reason.empty()) << text;
      for (const char* unit : {"deg", "rad", "mm", "um"})
        EXPECT_NE(error.fault().remedy.find(unit), std::string::npos) << text << ": " << unit;
    }
  }
}

Displacements moving(std::vector<Displacement> joints, Displacement tip = {0.0, 0.0, true}) {
  return {std::move(joints), tip};
}

TEST(Material, IsAJointThatMovesBeyondTheToleranceOfItsKind) {
  const Tolerance tolerance{1e-3, 1e-4};
  EXPECT_TRUE(isMaterial(moving({{1.1e-3, 1.5e-3, false}}), tolerance));
  EXPECT_FALSE(isMaterial(moving({{0.9e-3, 1.5e-3, false}}), tolerance));
  EXPECT_TRUE(isMaterial(moving({{1.1e-4, 1.5e-4, true}}), tolerance));
  EXPECT_FALSE(isMaterial(moving({{1.1e-4, 1.5e-4, false}}), tolerance)) << "an angle";
  EXPECT_TRUE(isMaterial(moving({{1e-5, 2e-5, false}, {2e-3, 3e-3, false}}), tolerance)) << "another joint";
}

/// A joint that jumps once moves little by RMS.
TEST(Material, IsAlsoAPeakOfThreeTimesTheTolerance) {
  const Tolerance tolerance{1e-3, 1e-4};
  EXPECT_TRUE(isMaterial(moving({{1e-4, 3.1e-3, false}}), tolerance));
  EXPECT_FALSE(isMaterial(moving({{1e-4, 2.9e-3, false}}), tolerance));
}

TEST(Material, IsTheTipWhereNoJointMoves) {
  const Tolerance tolerance{1e-3, 1e-4};
  EXPECT_TRUE(isMaterial(moving({{}, {}}, {1.1e-3, 1.5e-3, true}), tolerance)) << "an error of the cameras";
  EXPECT_FALSE(isMaterial(moving({{}, {}}, {0.9e-3, 1.5e-3, true}), tolerance));
  EXPECT_FALSE(isMaterial(moving({{1e-4, 1e-4, false}}, {5e-3, 9e-3, true}), tolerance))
      << "joints decide where one moves";
  EXPECT_FALSE(isMaterial({}, tolerance));
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Explainable channel(double named, double linear, double flexible, double share) {
  return {"q1", "rad", 1e-3, 20e-3, named, linear, flexible, share, {}};
}

TEST(Explainable, FallsShortWhereARegressionLeavesMateriallyLess) {
  const Tolerance tolerance{1e-3, 1e-4};
  // named² − least² is 24e-6 and 96e-6, to be compared with 1e-6
  EXPECT_TRUE(fallsShort({channel(5e-3, 1e-3, kNone, 0.5)}, tolerance));
  EXPECT_TRUE(fallsShort({channel(10e-3, kNone, 2e-3, 0.5)}, tolerance));
  EXPECT_FALSE(fallsShort({channel(5e-3, 1e-3, kNone, 0.95)}, tolerance)) << "nearly all is explained";
  EXPECT_FALSE(fallsShort({channel(1.1e-3, 0.1e-3, kNone, 0.5)}, tolerance)) << "nothing but noise is left";
  EXPECT_FALSE(fallsShort({channel(1.3e-3, 1.1e-3, kNone, 0.5)}, tolerance)) << "not material";
  EXPECT_FALSE(fallsShort({channel(5e-3, kNone, kNone, kNone)}, tolerance)) << "there is no regression";
  EXPECT_FALSE(fallsShort({}, tolerance));
}

TEST(Explainable, IsAllThatCanBeWhereNoRegressionExplainsMore) {
  EXPECT_TRUE(isAllThatCanBe({channel(5e-3, 4.9e-3, kNone, 0.97)}));
  EXPECT_TRUE(isAllThatCanBe({channel(5e-3, 4.9e-3, kNone, 0.97), channel(1.1e-3, 1e-3, kNone, 0.2)}))
      << "the other channel is noise";
  EXPECT_FALSE(isAllThatCanBe({channel(5e-3, 1e-3, kNone, 0.5)}));
  EXPECT_FALSE(isAllThatCanBe({channel(5e-3, kNone, kNone, kNone)})) << "nobody knows";
  EXPECT_FALSE(isAllThatCanBe({}));
}

}  // namespace
}  // namespace capstan::diagnosis
