/// A live set-up whose motor order, signs or units are wrong is named by the joint positions that it gives.
#include "core/live/motor_arrangement.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/robot/transmission.h"

namespace capstan::live {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

const robot::Description& raven() {
  static const robot::Description robot = robot::defaultDescription();
  return robot;
}
const double kDegree = base::toRadians(1.0);
const Vector3d kInside(60.0 * kDegree, 80.0 * kDegree, 0.34);

/// Rows of an arm that stands at `q`, as its motors count them.
recording::MeasuredTable standingAt(const Vector3d& q) {
  const Vector3d motor = robot::Transmission(raven()).motorFromJoint(q);
  recording::MeasuredTable table;
  table.file = "robot";
  table.q_m.resize(3);
  for (int row = 0; row < 50; ++row) {
    table.t.push_back(1e-3 * row);
    for (int k = 0; k < 3; ++k) table.q_m[static_cast<std::size_t>(k)].push_back(motor[k]);
  }
  return table;
}

/// What the check says of `table`; empty: nothing is wrong.
std::string faultOf(const recording::MeasuredTable& table, const RowsSetup& setup,
                    const std::string& read_as = {}) {
  try {
    EXPECT_TRUE(MotorArrangement(setup, raven(), recording::parseReadAs(read_as, "read_as")).check(table));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

void readAsDegrees(recording::MeasuredTable& table) {
  recording::readColumnsAs(table, raven(), recording::parseReadAs("q_m=deg", "read_as"));
}

/// A motor that counts the other way, of an arm that begins at its hard stop.
TEST(MotorArrangement, NamesAJointThatLeavesItsLimits) {
  RowsSetup setup;
  const MotorArrangement right(setup, raven(), {});
  EXPECT_EQ(right.beyondLimits(standingAt(kInside)), "");
  setup.signs = {-1.0, 1.0, 1.0};
  EXPECT_THAT(
      MotorArrangement(setup, raven(), {}).beyondLimits(standingAt(kInside)),
      HasSubstr("by the motors, joint 1 (" + raven().joints[0].name + ") has left its limits 0.0° to 90.0°"));
}

TEST(MotorArrangement, NamesAWrongOrder) {
  RowsSetup setup;
  setup.motors = {2, 1, 3};
  const std::string fault = faultOf(standingAt(kInside), setup);
  EXPECT_THAT(fault, HasSubstr("joint 1 (" + raven().joints[0].name + ") stands at −"));
  EXPECT_THAT(fault, HasSubstr("outside its limits 0.0° to 90.0°"));
  EXPECT_THAT(fault, HasSubstr("Check motors (which motor drives which joint), signs (-1 where"));
}

TEST(MotorArrangement, NamesAWrongSign) {
  RowsSetup setup;
  setup.signs = {1.0, -1.0, 1.0};
  const std::string fault = faultOf(standingAt(kInside), setup);
  EXPECT_THAT(fault, HasSubstr("joint 2 (" + raven().joints[1].name + ") stands at 1"));
  EXPECT_THAT(fault, HasSubstr("outside its limits 45.0° to 135.0°"));
  setup.signs = {1.0, 1.0, -1.0};
  EXPECT_THAT(faultOf(standingAt(kInside), setup), HasSubstr("mm, outside its limits 230.0 mm to 560.0 mm"));
}

TEST(MotorArrangement, NamesRadiansThatAreReadAsDegrees) {
  recording::MeasuredTable table = standingAt(kInside);
  readAsDegrees(table);
  const std::string fault = faultOf(table, {}, "q_m=deg");
  EXPECT_THAT(fault, HasSubstr("read_as = q_m=deg"));
  EXPECT_THAT(fault, HasSubstr("inside its limits (60.0°)"));
  EXPECT_EQ(faultOf(table, {}), "") << "the same numbers in radians are an arm beside its hard stop";
}

/// What a preview checks: positions outside the limits are there to be seen.
TEST(MotorArrangement, UnitsAreCheckedWithoutTheLimits) {
  RowsSetup setup;
  setup.signs = {1.0, -1.0, 1.0};
  EXPECT_TRUE(MotorArrangement(setup, raven(), {}).checkUnits(standingAt(kInside)));
  recording::MeasuredTable table = standingAt(kInside);
  readAsDegrees(table);
  const MotorArrangement degrees({}, raven(), recording::parseReadAs("q_m=deg", "read_as"));
  EXPECT_THROW(degrees.checkUnits(table), base::InputError);
}

TEST(MotorArrangement, DegreesThatAreReadAsSuchPass) {
  recording::MeasuredTable table = standingAt(kInside);
  for (auto& column : table.q_m)
    for (double& position : column) position /= kDegree;
  readAsDegrees(table);
  EXPECT_EQ(faultOf(table, {}, "q_m=deg"), "");
}

TEST(MotorArrangement, AnArmAtItsLimitsPasses) {
  const double stretch = 2.0 * kDegree;
  for (const double side : {0.0, 1.0}) {
    Vector3d q;
    for (int k = 0; k < 3; ++k) {
      const robot::Joint& joint = raven().joints[static_cast<std::size_t>(k)];
      q[k] = side == 0.0 ? joint.limit_low : joint.limit_high;
    }
    EXPECT_EQ(faultOf(standingAt(q), {}), "") << q.transpose();
    const Vector3d out((2.0 * side - 1.0) * Vector3d(stretch, stretch, 0.005));
    EXPECT_EQ(faultOf(standingAt(q + out), {}), "") << (q + out).transpose();
    EXPECT_NE(faultOf(standingAt(q + 10.0 * out), {}), "") << (q + 10.0 * out).transpose();
  }
  EXPECT_EQ(faultOf(standingAt(Vector3d(robot::Transmission(raven()).homing())), {}), "") << "hard stop";
}

TEST(MotorArrangement, ALostEncoderIsNotJudged) {
  recording::MeasuredTable table = standingAt(kInside);
  const double lost = std::numeric_limits<double>::quiet_NaN();
  for (double& position : table.q_m[2]) position = lost;
  EXPECT_EQ(faultOf(table, {}), "");
  RowsSetup wrong;
  wrong.signs = {1.0, -1.0, 1.0};
  EXPECT_THAT(faultOf(table, wrong), HasSubstr("joint 2")) << "which motor 3 does not move";
  for (double& position : table.q_m[0]) position = lost;
  EXPECT_FALSE(MotorArrangement({}, raven(), {}).check(table)) << "the next rows are judged";
}

}  // namespace
}  // namespace capstan::live
