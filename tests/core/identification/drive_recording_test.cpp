#include "core/identification/drive_recording.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "tests/core/identification/jaw.h"

namespace capstan::identification {
namespace {

recording::MeasuredTable table(const std::string& text) {
  return recording::parseMeasuredTable(text, "jaw.csv");
}

base::InputFault faultOf(const std::string& text) {
  try {
    driveRecording(table(text), 0.02);
  } catch (const base::InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

TEST(DriveRecording, RefusesWhatIsMissingByName) {
  const struct {
    const char *text, *column, *remedy;
  } cases[] = {
      {"t,tau_ext1,q1\n0,1,1\n0.1,1,1\n", "q_m1", "column q_m1"},
      {"t,q_m1,q1\n0,1,1\n0.1,1,1\n", "tau_ext1", "column tau_ext1"},
      {"t,q_m1,tau_ext1\n0,1,1\n0.1,1,1\n", "q1", "column q1"},
      {"t,q_m1,q_m2,tau_ext1,tau_ext2,q1,q2\n0,1,1,1,1,1,1\n0.1,1,1,1,1,1,1\n", "q_m1…2", "q_m1, tau_m1, q1"},
      {"t,q_m1,tau_ext1,q1\n0,1,1,1\n0.1,,1,1\n", "q_m1", "longer"},
  };
  for (const auto& expected : cases) {
    const base::InputFault fault = faultOf(expected.text);
    EXPECT_EQ(fault.file, "jaw.csv");
    EXPECT_EQ(fault.key, expected.column);
    EXPECT_NE(fault.remedy.find(expected.remedy), std::string::npos) << fault.remedy;
  }
}

TEST(DriveRecording, ThinsAndDifferentiates) {
  std::string text = "t,q_m1,tau_ext1,q1\n";
  for (int k = 0; k < 500; ++k)
    text += std::to_string(0.004 * k) + "," + std::to_string(2.0 * 0.004 * k) + ",0.5," +
            (k % 10 ? "1" : "") + "\n";
  const DriveRecording recording = driveRecording(table(text), 0.02);
  ASSERT_EQ(recording.size(), 100U);
  for (std::size_t k = 0; k < recording.size(); ++k) {
    EXPECT_NEAR(recording.t[k], 0.02 * static_cast<double>(k), 1e-9);
    EXPECT_NEAR(recording.dq_m[k], 2.0, 1e-3);
    EXPECT_TRUE(std::isnan(recording.tau_m[k]));
    EXPECT_EQ(std::isnan(recording.q[k]), k % 2 == 0) << "an empty cell stays empty";
  }
}

TEST(DriveRecording, VelocityIsTheTablesWhereItHasOne) {
  const DriveRecording recording =
      driveRecording(table("t,q_m1,dq_m1,tau_ext1,q1\n0,0,7,0,0\n0.1,0,8,0,0\n"), 0.02);
  EXPECT_EQ(recording.dq_m, (std::vector<double>{7.0, 8.0}));
}

TEST(DriveParameters, RefusesByName) {
  for (const char* names : {"", "stiffness", "r_l,r_l1", "r_l,,a", "r_l2"}) {
    try {
      const DriveParameters parameters(jaw(), names);
      ADD_FAILURE() << names;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().file, "--parameters");
      EXPECT_NE(error.fault().remedy.find(kAllDriveParameters), std::string::npos);
    }
  }
  const auto raven = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  try {
    const DriveParameters parameters(raven, "all");
    ADD_FAILURE();
  } catch (const base::InputError& error) {
    EXPECT_NE(error.fault().value.find("3 joints"), std::string::npos);
  }
  robot::Description frictionless = jaw();
  frictionless.joints.front().friction.viscous = 0.0;
  EXPECT_NO_THROW(DriveParameters(frictionless, "r_l,k_e"));
  EXPECT_THROW(DriveParameters(frictionless, "all"), base::InputError);
}

}  // namespace
}  // namespace capstan::identification
