#include "core/identification/parameters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/identification/estimate.h"
#include "core/identification/options.h"
#include "tests/core/identification/matched_recording.h"

namespace capstan::identification {
namespace {

robot::Description raven() { return robot::readDescription(base::resource("robots/raven2_left.yaml")); }

TEST(Parameters, NamesExpandInOrder) {
  const ParameterSet set(raven(), "r_l1, k_e,f_c3");
  ASSERT_EQ(set.size(), 5);
  const char* names[] = {"r_l1", "k_e1", "k_e2", "k_e3", "f_c3"};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(set[i].name(), names[i]);
  EXPECT_EQ(ParameterSet(raven(), "all").size(), kMostParameters);
}

TEST(Parameters, RefusesWhatIsNoParameter) {
  for (const char* names : {"", "k_e4", "r_l1,r_l1", "k_e2,k_e", "stiffness", "r_l1,,k_e"}) {
    try {
      const ParameterSet set(raven(), names);
      ADD_FAILURE() << names;
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("r_l1…3"), std::string::npos) << error.what();
    }
  }
}

TEST(Parameters, RobotAndKernelGetTheSameValues) {
  const ParameterSet set(raven(), "all");
  ParameterSet::Logs logs(set.size());
  for (int i = 0; i < set.size(); ++i) logs(i) = 0.01 * (i + 1);
  const auto by_robot = tracking::cableArmConstants(set.robot(logs));
  const auto direct = set.constants(logs);
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_DOUBLE_EQ(by_robot.link_radius[joint], direct.link_radius[joint]);
    EXPECT_DOUBLE_EQ(by_robot.stiffness[joint], direct.stiffness[joint]);
    EXPECT_DOUBLE_EQ(by_robot.damping[joint], direct.damping[joint]);
    EXPECT_DOUBLE_EQ(by_robot.coulomb[joint], direct.coulomb[joint]);
  }
  EXPECT_DOUBLE_EQ(set.robot(logs).drives[1].link_radius, 0.056298 * std::exp(0.02));
  EXPECT_DOUBLE_EQ(set.robot(logs).joints[2].friction.coulomb, 0.53 * std::exp(0.12));
}

TEST(Parameters, AnIdentifiedRobotIsARobotFile) {
  const ParameterSet set(raven(), "r_l1,k_e2");
  std::vector<Estimate> estimates(2);
  estimates[0] = {set[0], std::log(59.0 / 63.095), 1e-3, true, {}};
  estimates[1] = {set[1], 0.3, 0.9, false, "not seen"};
  const robot::Description robot = identifiedRobot(set, estimates);
  const robot::Description read = robot::parseDescription(robot::formatDescription(robot), "identified");
  const auto changes = differences(raven(), read);
  ASSERT_EQ(changes.size(), 1U) << "what was not seen stays nominal";
  EXPECT_EQ(changes[0].key, "drives[0].link_radius");
  EXPECT_NEAR(changes[0].identified, 0.059, 1e-15);
  EXPECT_NEAR(changes[0].percent, -6.4902, 1e-3);
}

TEST(Parameters, EffectsAreIdentifiedAroundOrRefused) {
  robot::Description extended = raven();
  extended.effects = {{"pulley_radius", 1, {{"share", 0.1}}}, {"camera_latency", 0, {{"delay", 0.01}}}};
  const ParameterSet set(extended, "r_l1");
  const double widened = 1.1 * raven().drives[0].link_radius;
  EXPECT_DOUBLE_EQ(set.constants(ParameterSet::Logs::Zero(1)).link_radius[0], widened);
  const robot::Description found = set.robot(ParameterSet::Logs::Constant(1, std::log(1.02)));
  EXPECT_DOUBLE_EQ(found.drives[0].link_radius, 1.02 * widened);
  ASSERT_EQ(found.effects.size(), 1U);  // the cameras'
  const std::vector<RobotChange> changes = differences(extended, found);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_NEAR(changes[0].percent, 2.0, 1e-9);
  extended.effects.push_back({"backlash", 2, {{"half_width", 1e-4}}});
  try {
    const ParameterSet refused(extended, "r_l1");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "effects");
    EXPECT_EQ(error.fault().value, "backlash");
  }
}

TEST(Parameters, TheFileOfDefaultsHoldsTheDefaults) {
  const auto read = base::readYamlFile<IdentificationOptions>(base::resource("identification/default.yaml"));
  const IdentificationOptions built_in;
  EXPECT_EQ(read.parameters.prior_sigma, built_in.parameters.prior_sigma);
  EXPECT_EQ(read.parameters.bound, built_in.parameters.bound);
  EXPECT_EQ(read.parameters.goal, built_in.parameters.goal);
  EXPECT_EQ(read.camera.sigmas(), built_in.camera.sigmas());
}

}  // namespace
}  // namespace capstan::identification
