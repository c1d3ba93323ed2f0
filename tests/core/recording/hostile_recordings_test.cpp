// Tables of strangers whose columns or times are impossible.
#include <gmock/gmock.h>

#include <fstream>

#include "core/base/error.h"
#include "core/recording/pose_table.h"
#include "core/recording/read_table.h"
#include "tests/core/recording/session_samples.h"
#include "tests/support/error_of.h"

namespace capstan::recording {
namespace {

using test::errorOf;
using ::testing::HasSubstr;

TEST(HostileTable,
     AColumnOfPosesIsGivenOnce) {  // twice traj was read as twice the rows, beyond the other columns
  const std::string header =
      "traj,traj,t_cam_s,cam_x,cam_y,cam_z,cam_qx,cam_qy,cam_qz,cam_qw,t_cmd_s,cmd_x,cmd_y,cmd_z,cmd_qx,cmd_"
      "qy,cmd_qz,cmd_qw\n";
  EXPECT_THAT(errorOf([&] { parsePoseTable(header + "1,2,0,1,1,1,0,0,0,1,0,1,1,1,0,0,0,1\n", "poses.csv"); }),
              HasSubstr("poses.csv:1: traj: is in the header twice. Rename or remove one"));
}

std::string motorLog(const std::string& more, const std::string& rows) {
  return "t_s,mpos1_deg,mpos2_deg,mpos3_deg,mvel1_degps,mvel2_degps,mvel3_degps,jpos1_deg,jpos2_deg,jpos3_m_"
         "times_57.2958,tau1,tau2,tau3" +
         more + "\n" + rows;
}

TEST(HostileTable, ATimeOfAMotorLogIsGivenOnce) {  // was read as twice the rows
  const testing::TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    std::ofstream(folder / "log.csv") << text;
    return errorOf([&] { readTable(folder / "log.csv", testing::raven()); });
  };
  EXPECT_THAT(complaint(motorLog(",t_s", "0,1,2,3,1,2,3,4,5,6,1,2,3,0.5\n1,1,2,3,1,2,3,4,5,6,1,2,3,1.5\n")),
              HasSubstr(":1: t_s: is in the header twice"));
  EXPECT_THAT(complaint(motorLog("", ",1,2,3,1,2,3,4,5,6,1,2,3\n")),
              HasSubstr(":2: t = nan: is beyond 1e+10 s"));
}

TEST(HostileTable, TimesAreOfThisWorld) {
  MeasuredTable table = parseMeasuredTable("t,q_m1\n1e300,1\n1e301,2\n", "table.csv");
  EXPECT_THAT(errorOf([&] { checkTimeRange(table); }),
              HasSubstr("table.csv:2: t = 1e+300: is beyond 1e+10 s"));
  EXPECT_THAT(errorOf([] { parseMeasuredTable("t,q_m1\n1e400,1\n", "table.csv"); }),
              HasSubstr("is not a finite number"));
  EXPECT_THAT(errorOf([] { parseMeasuredTable("t,q_m1\n0,nan\n", "table.csv"); }),
              HasSubstr("is not a finite number"));
}

}  // namespace
}  // namespace capstan::recording
