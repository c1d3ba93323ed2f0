// Tables of tip poses: what is a placeholder, a repeat, an outlier, and what is refused.
#include "core/diagnosis/evidence/pose_evidence.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/core/diagnosis/sampled_poses.h"

namespace capstan::diagnosis {
namespace {

constexpr const char* kShort = "traj,t_cam_s,cam_x,cam_y,cam_z,t_robot_s,robot_x,robot_y,robot_z\n";

void expectRefusal(const std::string& text, int line, const std::string& key) {
  try {
    parsePoseEvidence(text, "poses.csv");
    FAIL() << "not refused: " << key;
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "poses.csv");
    EXPECT_EQ(error.fault().line, line) << error.what();
    EXPECT_EQ(error.fault().key, key) << error.what();
    EXPECT_FALSE(error.fault().remedy.empty());
  }
}

TEST(PoseEvidence, KnowsItsTables) {
  EXPECT_TRUE(isPoseTable(testing::poseHeader()));
  EXPECT_TRUE(isPoseTable("traj,t_cam_s,cam_x,cam_y"));
  EXPECT_FALSE(isPoseTable("t,q_m1,tau_m1,q1"));
  EXPECT_FALSE(isPoseTable("trajectory,t_cam_s,cam_x"));
}

TEST(PoseEvidence, PlaceholdersAndRepeatsAreLeftOutAndCounted) {
  const std::string pose = ",0.01,0.02,-0.1,0,0,0,1", none = ",0,0,0,0,0,0,1", empty = ",,,,,,,";
  std::string text = testing::poseHeader();
  text += "0,0,1.00,1.00,0.00" + pose + pose + none + "\n";  // no command yet
  text += "0,0,1.02,1.02,1.02" + pose + pose + pose + "\n";
  text += "0,0,1.02,1.04,1.04" + pose + pose + pose + "\n";   // the cameras' last pose again
  text += "0,0,1.06,1.04,1.06" + pose + empty + pose + "\n";  // the robot was not read
  text += "0,1,0.50,0.50,0.50" + pose + pose + pose + "\n";   // another clock
  text += "0,1,0.52,0.52,0.52" + pose + pose + pose + "\n";
  const PoseEvidence evidence = parsePoseEvidence(text, "folder/poses.csv");
  EXPECT_EQ(evidence.title, "poses.csv");
  ASSERT_EQ(evidence.trajectories.size(), 2U);
  EXPECT_EQ(evidence.trajectories[1].name, "task 0, trajectory 1");
  EXPECT_EQ(evidence.camera.repeats, 1U);
  EXPECT_EQ(evidence.camera.placeholders, 0U);
  EXPECT_EQ(evidence.robot.placeholders, 1U);
  EXPECT_EQ(evidence.command.placeholders, 1U);
  EXPECT_EQ(evidence.command.poses(), 5U);
  EXPECT_EQ(evidence.trajectories[0].camera.size(), 3U);
  EXPECT_EQ(evidence.trajectories[0].robot.size(), 3U);
  EXPECT_EQ(evidence.trajectories[0].command.size(), 3U);
  EXPECT_EQ(evidence.trajectories[0].command[0].t, 1.02);
  EXPECT_TRUE(evidence.turns);
  EXPECT_EQ(evidence.notices.size(), 3U);
}

TEST(PoseEvidence, SightsThatNoTipCouldReachDoNotCount) {
  std::string text = kShort;
  for (int k = 0; k < 40; ++k) {
    const double x = k >= 10 && k < 13 ? 0.2 : 1e-3 * k;  // three observations of something else
    text +=
        fmt::format("7,{:.3f},{:.4f},0.02,-0.1,{:.3f},{:.4f},0.02,-0.1\n", 0.02 * k, x, 0.02 * k, 1e-3 * k);
  }
  const PoseEvidence evidence = parsePoseEvidence(text, "poses.csv");
  EXPECT_EQ(evidence.camera.outliers, 3U);
  for (int k = 0; k < 40; ++k)
    EXPECT_EQ(evidence.trajectories[0].camera[static_cast<std::size_t>(k)].counts, k < 10 || k >= 13) << k;
  EXPECT_FALSE(evidence.turns);
  EXPECT_EQ(evidence.trajectories[0].name, "trajectory 7");
}

TEST(PoseEvidence, RefusesWithPlaceAndRemedy) {
  const std::string row = "0,1.0,0.01,0.02,-0.1,1.0,0.01,0.02,-0.1\n";
  expectRefusal("traj,t_cam_s,cam_x,cam_y,t_robot_s,robot_x,robot_y,robot_z\n0,1,1,1,1,1,1,1\n", 1, "cam_z");
  expectRefusal("traj,t_cam_s,cam_x,cam_y,cam_z\n0,1,1,1,1\n", 1, "t_robot_s");
  expectRefusal("t_cam_s,cam_x,cam_y,cam_z,t_robot_s,robot_x,robot_y,robot_z\n1,1,1,1,1,1,1,1\n", 1, "traj");
  expectRefusal(kShort + row + "0,0.9,0.01,0.02,-0.1,1.1,0.01,0.02,-0.1\n", 3, "t_cam_s");
  expectRefusal(kShort + row, 0, "traj");
  expectRefusal(testing::poseHeader() + std::string("0,0,1,1,1,1,1,1,0,0,0,2,1,1,1,0,0,0,1,1,1,1,0,0,0,1\n"),
                2, "cam_qw");
}

}  // namespace
}  // namespace capstan::diagnosis
