#include "core/registration/registration_history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/yaml.h"
#include "core/registration/registration_difference.h"
#include "core/vision/registration_file.h"
#include "tests/support/error_of.h"
#include "tests/support/folders.h"
#include "tests/support/temporary_folder.h"

namespace capstan::registration {
namespace {

using ::testing::HasSubstr;

Eigen::Isometry3d poseAt(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& translation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

HistoryEntry entryAt(const std::string& date, const Eigen::Isometry3d& pose) {
  HistoryEntry entry;
  entry.date = date;
  entry.robot = "RAVEN-II left";
  entry.session = "a: \"session\" # 7";
  entry.rms = 3.25e-4;
  entry.leave_one_out_rms = 4e-4;
  entry.used = 17;
  entry.excluded = 3;
  entry.setPose(pose);
  return entry;
}

class History : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "deep" / "registrations.yaml";
};

TEST_F(History, KeepsEveryDecisionToTheLastBit) {
  EXPECT_TRUE(readHistory(file_).empty()) << "no file is no history";
  const auto pose = poseAt(0.7, {1.0, 2.0, -3.0}, {0.1, -0.2, 1.0 / 3.0});
  addToHistory(file_, entryAt("2026-11-28T10:00:00", pose));
  HistoryEntry rejected;
  rejected.date = "2026-11-28T11:00:00";
  rejected.decision = Decision::kRejected;
  rejected.method = Method::kHardStop;
  rejected.robot = "RAVEN-II left";
  rejected.reason = "Überlagerung: \"falsch\",\nzwei Zeilen";
  EXPECT_EQ(addToHistory(file_, rejected).size(), 2u);
  const auto entries = readHistory(file_);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].date, "2026-11-28T10:00:00");
  EXPECT_EQ(entries[0].session, "a: \"session\" # 7");
  EXPECT_EQ(entries[0].used, 17);
  EXPECT_EQ(*entries[0].rms, 3.25e-4);
  ASSERT_TRUE(entries[0].pose());
  EXPECT_EQ(entries[0].pose()->matrix(), pose.matrix());
  EXPECT_EQ(entries[1].decision, Decision::kRejected);
  EXPECT_EQ(entries[1].reason, rejected.reason);
  EXPECT_FALSE(entries[1].pose());
  EXPECT_FALSE(entries[1].rms);
}

/// A computed rotation exceeds 1 by rounding: it is written, so it must be read.
TEST_F(History, ARotationThatExceedsOneByRoundingIsRead) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear()(1, 1) = 1.0000000000000004;
  addToHistory(file_, entryAt("2026-11-28T10:00:00", pose));
  EXPECT_EQ(readHistory(file_)[0].pose()->matrix(), pose.matrix());
  const auto single = folder_.path() / "registration.yaml";
  vision::writeRegistration(pose, single);
  EXPECT_EQ(vision::readRegistration(single).matrix(), pose.matrix());
  pose.linear()(1, 1) = 1.01;
  vision::writeRegistration(pose, single);
  EXPECT_THAT(test::errorOf([&] { vision::readRegistration(single); }), HasSubstr("rotation"));
}

TEST_F(History, AFileThatCannotBeReadIsLeftAsItIs) {
  std::filesystem::create_directories(file_.parent_path());
  const std::string broken = "registrations:\n  - date: 2026-11-28T10:00:00\n    decision: perhaps\n";
  std::ofstream(file_) << broken;
  const std::string said = test::errorOf([&] {
    addToHistory(file_, entryAt("x", poseAt(0, {1, 0, 0}, {0, 0, 0})));
  });
  EXPECT_THAT(said, HasSubstr("registrations[0].decision"));
  EXPECT_THAT(said, HasSubstr("accepted, rejected, restored, imported"));
  EXPECT_EQ(base::readTextFile(file_), broken);
}

TEST_F(History, RefusesARotationThatIsNone) {
  auto entry = entryAt("2026-11-28T10:00:00", poseAt(0.1, {0, 0, 1}, {0, 0, 0}));
  (*entry.rotation)(0, 0) = 0.5;
  addToHistory(file_, entry);
  EXPECT_THAT(test::errorOf([&] { readHistory(file_); }), HasSubstr("registrations[0].rotation"));
  std::filesystem::remove(file_);
  entry.rotation.reset();
  addToHistory(file_, entry);
  EXPECT_THAT(test::errorOf([&] { readHistory(file_); }), HasSubstr("only one of translation and rotation"));
}

TEST_F(History, ForgetsTheOldestEntries) {
  const auto pose = poseAt(0.1, {0, 0, 1}, {0, 0, 0});
  std::size_t kept = 0;
  for (int i = 0; i < 5; ++i) {
    auto entry = entryAt(std::to_string(i), pose);
    entry.reason = std::string(300'000, 'x');  // three of them are all that a file may hold
    kept = addToHistory(file_, entry).size();
  }
  const auto entries = readHistory(file_);
  EXPECT_EQ(entries.size(), kept);
  ASSERT_GE(entries.size(), 2u);
  EXPECT_EQ(entries.back().date, "4");
  EXPECT_LE(std::filesystem::file_size(file_), base::kLongestYaml);
}

TEST_F(History, AnEntryOfAFitHasItsNumbers) {
  PairRegistration fit;
  fit.base_from_camera = poseAt(0.3, {0, 1, 0}, {0.2, 0, 0});
  fit.rms = 1e-3;
  fit.leave_one_out_rms = 2e-3;
  fit.used = {true, true, false, true, true};
  const HistoryEntry entry = entryOf(Decision::kAccepted, fit);
  EXPECT_EQ(entry.used, 4);
  EXPECT_EQ(entry.excluded, 1);
  EXPECT_EQ(entry.method, Method::kPoses);
  EXPECT_EQ(*entry.leave_one_out_rms, 2e-3);
  EXPECT_EQ(entry.pose()->matrix(), fit.base_from_camera.matrix());
}

TEST(RegistrationDifference, OfATranslationIsTheSameEverywhere) {
  const auto robot = robot::readDescription(test::resourceFile("robots/raven2_left.yaml"));
  const auto from = poseAt(1.1, {1, 1, 0}, {0.1, 0.2, 0.3});
  Eigen::Isometry3d to = from;
  to.translation() += Eigen::Vector3d(0.003, 0.0, -0.004);
  const auto difference = differenceOf(from, to, robot);
  EXPECT_NEAR(difference.translation.norm(), 0.005, 1e-12);
  EXPECT_NEAR(difference.rotation, 0.0, 1e-7);
  EXPECT_NEAR(difference.tool.median, 0.005, 1e-12);
  EXPECT_NEAR(difference.tool.largest, 0.005, 1e-12);
  EXPECT_EQ(wordsOf(difference),
            "translation 5.00 mm (3.00, 0.00, −4.00), rotation 0.00°, at the tool 5.00 mm, at most 5.00 mm "
            "over the workspace");
}

/// A rotation by θ about an axis through frame 0 moves a tip at distance r from the axis by 2 r sin(θ/2).
TEST(RegistrationDifference, OfARotationGrowsWithTheDistanceFromItsAxis) {
  const auto robot = robot::readDescription(test::resourceFile("robots/raven2_left.yaml"));
  const double angle = 0.02;
  const auto from = poseAt(1.1, {1, 1, 0}, {0.1, 0.2, 0.3});
  const Eigen::Isometry3d to = poseAt(angle, {0, 0, 1}, {0, 0, 0}) * from;
  double farthest = 0.0;
  for (const auto& tip : workspaceTips(robot)) farthest = std::max(farthest, tip.head<2>().norm());
  ASSERT_GT(farthest, 0.1);
  const auto difference = differenceOf(from, to, robot);
  EXPECT_NEAR(difference.rotation, angle, 1e-9);
  EXPECT_NEAR(difference.tool.largest, 2.0 * farthest * std::sin(0.5 * angle), 1e-12);
  EXPECT_LT(difference.tool.median, difference.tool.largest);
}

}  // namespace
}  // namespace capstan::registration
