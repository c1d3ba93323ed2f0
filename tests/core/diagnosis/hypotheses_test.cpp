// The library of hypotheses is complete, speaks to people in whole sentences, and gives fits starts that a
// robot of any size can have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

#include "core/diagnosis/fit/fit_model.h"
#include "core/diagnosis/hypotheses/hypothesis.h"
#include "tests/core/diagnosis/data_folder.h"

namespace capstan::diagnosis {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;
using testing::Not;

/// Of joint `joint` (from 1) in a minute's recording at half its top speed.
JointScales scalesOf(const robot::Description& robot, int joint, bool rigid) {
  const robot::Joint& j = robot.joints.at(static_cast<std::size_t>(joint - 1));
  const robot::Drive& drive = robot.drives.at(static_cast<std::size_t>(joint - 1));
  JointScales scales;
  scales.range = j.limit_high - j.limit_low;
  scales.speed = 0.5 * j.max_speed;
  scales.coulomb = std::max(j.friction.coulomb, 0.1);
  scales.viscous = j.friction.viscous;
  const double arm = j.type == robot::JointType::kPrismatic ? 1.0 : j.link.centre_of_mass.norm();
  scales.inertia = j.link.mass * arm * arm;
  scales.radius = drive.link_radius;
  scales.capstan = drive.motor_capstan_radius;
  scales.gear = drive.gear_ratio;
  if (!rigid) {
    scales.stiffness = 2.0 * drive.cable_stiffness * drive.cable_exponent;
    scales.stretch = 3.0 * scales.coulomb / scales.radius / scales.stiffness;
  }
  scales.duration = 60.0;
  scales.joints = robot.size();
  return scales;
}

struct Asked {
  JointScales scales;
  int joint;
  bool rigid;
};

std::vector<Asked> everyJoint() {
  std::vector<Asked> all;
  for (int joint = 1; joint <= 3; ++joint) all.push_back({scalesOf(raven(), joint, false), joint, false});
  for (int joint = 1; joint <= 3; ++joint) all.push_back({scalesOf(raven(), joint, true), joint, true});
  all.push_back({scalesOf(slide(), 1, true), 1, true});
  return all;
}

bool makesSense(const Hypothesis& hypothesis, const Asked& asked) {
  if (hypothesis.name() == "cable_coupling" && asked.scales.joints == 1) return false;
  return asked.rigid ? hypothesis.facts->rigid : hypothesis.facts->cable;
}

const Hypothesis& named(std::string_view name) {
  const Hypothesis* hypothesis = hypothesisNamed(name);
  if (hypothesis == nullptr) throw std::invalid_argument(std::string(name));
  return *hypothesis;
}

TEST(Hypotheses, AreOneForEachEffect) {
  ASSERT_EQ(hypotheses().size(), robot::effectFacts().size());
  for (std::size_t i = 0; i < hypotheses().size(); ++i) {
    EXPECT_EQ(hypotheses()[i].facts, &robot::effectFacts()[i]);
    EXPECT_EQ(hypothesisNamed(hypotheses()[i].name()), &hypotheses()[i]);
  }
  EXPECT_EQ(hypothesisNamed("gremlins"), nullptr);
}

TEST(Hypotheses, SpeakInWholeSentences) {
  std::set<std::string_view> said;
  for (const Hypothesis& hypothesis : hypotheses()) {
    SCOPED_TRACE(hypothesis.name());
    const HypothesisWords& words = hypothesis.words;
    for (const std::string_view text : {words.what, words.changes, words.signature, words.experiment}) {
      SCOPED_TRACE(text);
      ASSERT_GT(text.size(), 20U);
      EXPECT_TRUE(text[0] >= 'A' && text[0] <= 'Z');
      EXPECT_THAT(text, EndsWith("."));
      EXPECT_THAT(std::string(text), Not(testing::ContainsRegex("  |[.][.]| [.,;]|- ")));
    }
    for (const std::string_view text : {words.title, words.equation, words.source}) {
      SCOPED_TRACE(text);
      ASSERT_FALSE(text.empty());
      EXPECT_THAT(text, Not(EndsWith(".")));
    }
    for (const std::string_view text : {words.title, words.what, words.equation, words.signature})
      EXPECT_TRUE(said.insert(text).second) << text;
    EXPECT_TRUE(std::regex_search(std::string(words.source), std::regex("(19|20)[0-9][0-9]")));
  }
}

/// What each says it changes begins with the place where it sits.
TEST(Hypotheses, SayWhereTheySit) {
  const auto word = [](Place place) -> std::string_view {
    switch (place) {
      case Place::kTransmission:
        return "Transmission: ";
      case Place::kCable:
        return "Cable: ";
      case Place::kFriction:
        return "Friction: ";
      case Place::kRigidBody:
        return "Rigid body: ";
      case Place::kSensor:
        return "Sensor: ";
      case Place::kClock:
        return "Clock: ";
    }
    return "";
  };
  for (const Hypothesis& hypothesis : hypotheses())
    EXPECT_TRUE(hypothesis.words.changes.starts_with(word(hypothesis.place))) << hypothesis.name();
}

/// Each number of an effect stands in its equation by name.
TEST(Hypotheses, EquationsNameTheirNumbers) {
  for (const Hypothesis& hypothesis : hypotheses())
    for (const robot::EffectParameter& parameter : hypothesis.facts->parameters) {
      if (parameter.name == "mass" || parameter.name == "present") continue;  // of the body's; a yes or no
      EXPECT_NE(hypothesis.words.equation.find(parameter.name), std::string_view::npos)
          << hypothesis.name() << ": " << parameter.name;
    }
}

TEST(Hypotheses, NeutralIsWithinBoundsAndNothing) {
  for (const Hypothesis& hypothesis : hypotheses()) {
    SCOPED_TRACE(hypothesis.name());
    const auto& parameters = hypothesis.facts->parameters;
    const std::vector<double>& neutral = hypothesis.neutral;
    ASSERT_EQ(neutral.size(), parameters.size());
    for (std::size_t i = 0; i < neutral.size(); ++i) {
      EXPECT_GE(neutral[i], parameters[i].low);
      EXPECT_LE(neutral[i], parameters[i].high);
    }
    EXPECT_EQ(hypothesis.size(neutral), 0.0);
  }
}

TEST(Hypotheses, StartsAreWithinBounds) {
  for (const Hypothesis& hypothesis : hypotheses())
    for (const Asked& asked : everyJoint()) {
      if (!makesSense(hypothesis, asked)) continue;
      SCOPED_TRACE(hypothesis.name());
      const auto& parameters = hypothesis.facts->parameters;
      const auto starts = hypothesis.starts(asked.scales, hypothesis.facts->whole ? 0 : asked.joint);
      EXPECT_FALSE(starts.empty());
      for (const EffectStart& start : starts) {
        ASSERT_EQ(start.value.size(), parameters.size());
        ASSERT_EQ(start.scale.size(), parameters.size());
        for (std::size_t i = 0; i < parameters.size(); ++i) {
          EXPECT_GE(start.value[i], parameters[i].low) << parameters[i].name;
          EXPECT_LE(start.value[i], parameters[i].high) << parameters[i].name;
          EXPECT_GE(start.scale[i], 0.0) << parameters[i].name;
          EXPECT_LE(start.scale[i], parameters[i].high - parameters[i].low) << parameters[i].name;
        }
        EXPECT_EQ(start.scale[0] == 0.0, hypothesis.name() == "sensor_sign");
      }
    }
}

/// A derivative at neutral tells nothing of a shape: these start with some of it.
TEST(Hypotheses, ShapesStartWithSomeOfIt) {
  const std::set<std::string_view> shapes = {
      "backlash", "slack", "cable_hysteresis", "cable_creep", "stribeck_friction", "sensor_sign"};
  for (const Hypothesis& hypothesis : hypotheses())
    for (const Asked& asked : everyJoint()) {
      if (!makesSense(hypothesis, asked)) continue;
      const bool spring = asked.rigid && hypothesis.name() == "cable_compliance";
      for (const EffectStart& start : hypothesis.starts(asked.scales, asked.joint))
        EXPECT_EQ(hypothesis.size(start.value) > 0.0, spring || shapes.contains(hypothesis.name()))
            << hypothesis.name();
    }
}

/// A robot of which next to nothing is known, or whose numbers are out of all proportion.
TEST(Hypotheses, StrangeScalesGiveNoStrangeStarts) {
  JointScales stiff = scalesOf(raven(), 1, false);
  stiff.stiffness = 1e12;
  JointScales stretched = scalesOf(raven(), 1, false);
  stretched.stretch = 50.0;
  JointScales frictionless = scalesOf(raven(), 1, false);
  frictionless.coulomb = 0.0;
  for (const JointScales& scales : {JointScales{}, stiff, stretched, frictionless})
    for (const Hypothesis& hypothesis : hypotheses())
      for (const EffectStart& start : hypothesis.starts(scales, 1))
        for (std::size_t i = 0; i < start.value.size(); ++i) {
          const robot::EffectParameter& parameter = hypothesis.facts->parameters[i];
          SCOPED_TRACE(std::string(hypothesis.name()) + ": " + std::string(parameter.name));
          EXPECT_GE(start.value[i], parameter.low);
          EXPECT_LE(start.value[i], parameter.high);
          EXPECT_TRUE(std::isfinite(start.scale[i]));
        }
  EXPECT_THAT(named("backlash").starts({}, 1), IsEmpty());
  EXPECT_THAT(named("encoder_slip").starts({}, 1), IsEmpty());
  EXPECT_THAT(named("position_friction").starts({}, 1), IsEmpty());
  EXPECT_FALSE(named("cable_hysteresis").starts(frictionless, 1).empty());
  EXPECT_FALSE(named("viscous_friction").starts(frictionless, 1).empty());
}

/// What is a large compliance goes by the nominal cable; where that is as good as rigid, by how far the
/// forces of the recording would move the joint: a tenth of its range.
TEST(Hypotheses, ComplianceOfACableTakenForRigidGoesByForces) {
  JointScales scales = scalesOf(raven(), 1, false);
  scales.stretch = 0.05 * scales.radius * scales.range;
  ASSERT_EQ(named("cable_compliance").starts(scales, 1).size(), 1U);
  EXPECT_EQ(named("cable_compliance").starts(scales, 1).front().scale[0], 1.0 / scales.stiffness);
  const double force = 120.0;  // N in the cable, a third of it measured load
  scales.stiffness = force / (1e-4 * scales.radius * scales.range);
  scales.stretch = 80.0 / scales.stiffness;
  scales.load = 40.0 * scales.radius;
  const auto starts = named("cable_compliance").starts(scales, 1);
  ASSERT_EQ(starts.size(), 2U);
  EXPECT_EQ(starts[0].scale[0], 1.0 / scales.stiffness);
  EXPECT_NEAR(force * starts[1].scale[0] / scales.radius, 0.1 * scales.range, 1e-12);
}

TEST(Hypotheses, CouplingTriesEveryOtherJoint) {
  const auto others = [](int joints, int joint) {
    JointScales scales;
    scales.joints = joints;
    std::vector<double> found;
    for (const EffectStart& start : named("cable_coupling").starts(scales, joint)) {
      found.push_back(start.value[1]);
      EXPECT_EQ(start.scale[1], 0.0) << "which joint it is stays as it is";
    }
    return found;
  };
  EXPECT_THAT(others(4, 2), ElementsAre(1.0, 3.0, 4.0));
  EXPECT_THAT(others(3, 3), ElementsAre(1.0, 2.0));
  EXPECT_THAT(others(1, 1), IsEmpty());
}

TEST(Hypotheses, SlipsStartAllOverTheRecording) {
  const JointScales scales = scalesOf(raven(), 1, false);
  const auto starts = named("encoder_slip").starts(scales, 1);
  ASSERT_EQ(starts.size(), 12U);
  EXPECT_NEAR(starts.front().value[1], 6.0, 1e-9);
  EXPECT_NEAR(starts.back().value[1], 54.0, 1e-9);
  for (std::size_t i = 1; i < starts.size(); ++i)
    EXPECT_NEAR(starts[i].value[1] - starts[i - 1].value[1], 48.0 / 11.0, 1e-9);
  // One hundredth of the range, as the motor turns for it.
  const robot::Drive drive = raven().drives[0];
  EXPECT_NEAR(starts[0].scale[0] * drive.motor_capstan_radius / drive.gear_ratio / drive.link_radius,
              0.01 * scales.range, 1e-12);
}

/// The mass on the spring: ω² = k r² / I with k = 1 / compliance.
TEST(Hypotheses, ASpringInARigidDriveStartsByItsResonance) {
  const JointScales scales = scalesOf(slide(), 1, true);
  std::vector<double> hertz;
  for (const EffectStart& start : named("cable_compliance").starts(scales, 1))
    hertz.push_back(std::sqrt(scales.radius * scales.radius / start.value[0] / scales.inertia) /
                    (2.0 * std::numbers::pi));
  EXPECT_THAT(hertz, ElementsAre(testing::DoubleNear(5.0, 1e-9), testing::DoubleNear(10.0, 1e-9),
                                 testing::DoubleNear(20.0, 1e-9)));
}

TEST(Hypotheses, AVectorsSizeIsItsLength) {
  for (const char* name : {"gravity_tilt", "camera_rotation", "camera_offset"})
    EXPECT_NEAR(named(name).size({-0.03, 0.04, 0.12}), 0.13, 1e-15) << name;
  EXPECT_NEAR(named("capstan_eccentricity").size({-3e-4, 4e-4}), 5e-4, 1e-18);
  EXPECT_NEAR(named("position_friction").size({0.3, -0.4, 7.0}), 0.5, 1e-15) << "its period is none of it";
  EXPECT_EQ(named("pulley_radius").size({-0.02}), 0.02);
  EXPECT_EQ(named("cable_coupling").size({-0.02, 2.0}), 0.02);
}

/// The less pretension, the more slack there is. Cables that are too long have the play of a backlash, which
/// is another hypothesis.
TEST(Hypotheses, SlackGrowsAsPretensionFalls) {
  const Hypothesis& slack = named("slack");
  EXPECT_NEAR(slack.size({1e-3}), 999.999, 1e-9);
  double before = -1.0;
  for (const double pretension : {1e3, 1.0, 1e-2, 1e-4, 1e-6}) {
    const double size = slack.size({pretension});
    EXPECT_GT(size, before) << pretension;
    before = size;
  }
  const JointScales scales = scalesOf(raven(), 2, false);
  const FitModel model = FitModel(raven(), {scalesOf(raven(), 1, false), scales, scalesOf(raven(), 3, false)})
                             .with(slack, 2, slack.starts(scales, 2).front());
  EXPECT_EQ(model.parameters().back().low, 0.0);
}

/// A single block contains what happened in the first or the last second.
TEST(Hypotheses, EventsAreLookedForWithinTheRecording) {
  JointScales scales = scalesOf(raven(), 1, false);
  scales.duration = 20.0;
  EXPECT_EQ(eventTimes(scales), (std::pair{kFromEnds, 20.0 - kFromEnds}));
  const Hypothesis& slip = named("encoder_slip");
  const FitModel model =
      FitModel(raven(), {scales, scales, scales}).with(slip, 1, slip.starts(scales, 1).front());
  EXPECT_EQ(model.parameters().back().low, kFromEnds);
  EXPECT_EQ(model.parameters().back().high, 20.0 - kFromEnds);
  scales.duration = 2.0;
  EXPECT_EQ(eventTimes(scales), (std::pair{0.2, 1.8}));
}

TEST(Hypotheses, EveryRobotHasALittleOfThree) {
  const JointScales scales = scalesOf(raven(), 2, false);
  for (const Hypothesis& hypothesis : hypotheses()) {
    const double background = hypothesis.background(scales);
    const bool expected = hypothesis.name() == "asymmetric_friction" ||
                          hypothesis.name() == "stribeck_friction" ||
                          hypothesis.name() == "capstan_eccentricity";
    EXPECT_EQ(background > 0.0, expected) << hypothesis.name();
    if (expected) {  // a tenth or so of what would be large
      EXPECT_LT(5.0 * background, hypothesis.size(hypothesis.starts(scales, 2).at(0).scale));
    }
  }
  EXPECT_NEAR(named("capstan_eccentricity").background(scales),
              1.1e-3 * raven().drives[1].motor_capstan_radius, 1e-15);
}

}  // namespace
}  // namespace capstan::diagnosis
