#include "core/recording/pose_table.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace capstan::recording {
namespace {

constexpr const char* kHeader =
    "task,traj,t_cam_s,cam_x,cam_y,cam_z,cam_qx,cam_qy,cam_qz,cam_qw,"
    "t_cmd_s,cmd_x,cmd_y,cmd_z,cmd_qx,cmd_qy,cmd_qz,cmd_qw\n";

TEST(PoseTable, isReadTrajectoryByTrajectory) {
  const auto motions = parsePoseTable(std::string(kHeader) +
                                          "1,4,0.5,1,2,3,0,0,0,1,0.6,4,5,6,0,0,1,0\n"
                                          "1,4,0.7,1,2,3,0,0,0,1,0.8,4,5,6,0,0,1,0\n"
                                          "2,4,0.1,1,2,3,0,0,0,1,,,,,,,,\n",
                                      "poses.csv");
  ASSERT_EQ(motions.size(), 2U);
  EXPECT_EQ(motions[0].name, "task 1, trajectory 4");
  EXPECT_EQ(motions[1].name, "task 2, trajectory 4");
  ASSERT_EQ(motions[0].streams[0].size(), 2U);
  EXPECT_TRUE(motions[0].streams[1].empty()) << "no robot";
  const learning::RawPose& commanded = motions[0].streams[2][1];
  EXPECT_EQ(commanded.row, 3U);
  EXPECT_EQ(commanded.t, 0.8);
  EXPECT_EQ(commanded.position, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(commanded.quaternion, Eigen::Vector4d(0.0, 0.0, 1.0, 0.0));
  EXPECT_TRUE(std::isnan(motions[1].streams[2][0].t)) << "empty cells stay for the screening to list";
}

/// What is thrown names file, line, column and remedy.
void expectRefused(const std::string& text, const char* column) {
  try {
    parsePoseTable(text, "poses.csv");
    FAIL() << "not refused";
  } catch (const base::InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("poses.csv"), std::string::npos) << words;
    EXPECT_NE(words.find(column), std::string::npos) << words;
  }
}

TEST(PoseTable, refusesWhatItCannotUse) {
  std::string header = kHeader;
  const std::string row = "1,4,0.5,1,2,3,0,0,0,1,0.6,4,5,6,0,0,1,0\n";
  expectRefused("task,t_cam_s,cam_x\n1,2,3\n", "traj");
  expectRefused("traj,t_cam_s,cam_x,cam_y,cam_z,cam_qx,cam_qy,cam_qz,cam_qw\n1,0,0,0,0,0,0,0,1\n",
                "t_robot_s");
  std::string no_turn = header;
  no_turn.replace(no_turn.find("cmd_qw"), 6, "cmd_no");
  expectRefused(no_turn + row, "cmd_qw");
  expectRefused(header + "1,4,0.5,1,2,three,0,0,0,1,0.6,4,5,6,0,0,1,0\n", "cam_z");
  expectRefused(header, "");
}

std::string refusedOf(const std::vector<std::string>& tables, const std::string& file) {
  try {
    namingTables(tables, [&]() -> int {
      throw base::InputError({file, 0, "camera", {}, "has no pose", {}});
    });
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PoseTable, namesTablesWhereNoneIsNamed) {
  EXPECT_EQ(refusedOf({"a.csv"}, ""), "a.csv: camera: has no pose");
  EXPECT_EQ(refusedOf({"a.csv", "b.csv"}, ""), "a.csv and 1 more table: camera: has no pose");
  EXPECT_EQ(refusedOf({"a.csv", "b.csv", "c.csv"}, ""), "a.csv and 2 more tables: camera: has no pose");
  EXPECT_EQ(refusedOf({"a.csv", "b.csv"}, "b.csv"), "b.csv: camera: has no pose");
}

}  // namespace
}  // namespace capstan::recording
