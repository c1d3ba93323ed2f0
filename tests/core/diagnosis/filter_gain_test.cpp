// What the Kalman filter gains from a diagnosis: on recordings of planted robots, and where it cannot be
// said.
#include "core/diagnosis/filter_gain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/recording/table_source.h"
#include "core/tracking/track_all.h"
#include "tests/core/diagnosis/data_folder.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

test::Recording plantedRecording(const std::string& effect, int joint, double duration) {
  test::DrawOptions options;
  options.robot = raven();
  options.duration = duration;
  options.textured = false;
  options.effects = effect.empty() ? 0 : 1;
  if (!effect.empty()) {
    options.effect = test::effectNamed(effect)->effect;
    options.joint = joint;
    options.size = 0.8;
  }
  return test::record(test::draw(11, options));
}

const test::Recording& plain() {
  static const test::Recording recording = plantedRecording("", 0, 8.0);
  return recording;
}

Evidence plainEvidence() { return evidenceOf(plain().table, plain().robot); }

FilterRobots threeTimes(const robot::Description& robot) { return {robot, robot, robot}; }

std::array<double, 3> nominalOf(const FilterGainReport& report) {
  if (report.joints.size() != 3) return {-1.0, -1.0, -1.0};
  return {report.joints[0].nominal, report.joints[1].nominal, report.joints[2].nominal};
}

struct PlantedAt {
  const char* effect;
  int joint;
};

class FilterGainOf : public ::testing::TestWithParam<PlantedAt> {};

void record(const std::string& prefix, const FilterGainReport& report) {
  for (const FilterGain& one : report.joints)
    ::testing::Test::RecordProperty(prefix + one.joint, fmt::format("{:.3g} {:.3g} {:.3g} {}", one.nominal,
                                                                    one.refitted, one.extended, one.unit));
}

/// With the noise that stands for what a nominal model does not know, and with a tenth of it, where what the
/// extended robot knows can show.
TEST_P(FilterGainOf, APlantedEffectIsSmallerErrors) {
  const auto [effect, joint] = GetParam();
  const test::Recording recording = plantedRecording(effect, joint, 12.0);
  const std::vector<Evidence> evidence = {evidenceOf(recording.table, recording.robot)};
  DiagnosisOptions options;
  options.only = {effect};
  options.material = {1e-7, 1e-7};  // what is found, however small
  options.show = false;
  const Report report = diagnose(evidence, recording.robot, options);
  ASSERT_EQ(report.causes.size(), 1U) << report.summary;
  const FilterRobots robots = {recording.robot, report.refitted, report.extended};
  const FilterGainReport gain = filterGain(evidence, robots);
  FilterGainOptions sure;
  sure.tracking.position_noise *= 0.1;
  sure.tracking.velocity_noise *= 0.1;
  const FilterGainReport gain_sure = filterGain(evidence, robots, sure);
  ASSERT_EQ(gain.joints.size(), 3U);
  ASSERT_EQ(gain_sure.joints.size(), 3U);
  record("", gain);
  record("sure_", gain_sure);
  const auto j = static_cast<std::size_t>(joint - 1);
  EXPECT_LT(gain.joints[j].extended, 0.9 * gain.joints[j].nominal);
  EXPECT_LT(gain_sure.joints[j].extended, 0.6 * gain_sure.joints[j].nominal);
  EXPECT_LT(gain_sure.joints[j].extended, 0.7 * gain_sure.joints[j].refitted);
}

INSTANTIATE_TEST_SUITE_P(Effects, FilterGainOf,
                         ::testing::Values(PlantedAt{"homing_offset", 1},
                                           PlantedAt{"capstan_eccentricity", 3}, PlantedAt{"backlash", 2}),
                         [](const auto& of) { return std::string(of.param.effect); });

TEST(FilterGain, IsWhatTrackingTheTableGives) {
  recording::TableSource source(plain().table, plain().robot);
  tracking::TrackingPipeline pipeline(plain().robot, std::nullopt, {}, tracking::sixState());
  const Eigen::Vector3d expected = tracking::trackAll(source, pipeline).errors.ukf().value();
  const FilterGainReport report = filterGain({plainEvidence()}, threeTimes(plain().robot));
  ASSERT_EQ(report.joints.size(), 3U);
  for (std::size_t j = 0; j < 3; ++j) {
    const FilterGain& one = report.joints[j];
    EXPECT_NEAR(one.nominal, expected[static_cast<Eigen::Index>(j)], 1e-6 * one.nominal);
    EXPECT_EQ(one.refitted, one.nominal);
    EXPECT_EQ(one.extended, one.nominal);
  }
  EXPECT_EQ(report.joints[0].unit, "rad");
  EXPECT_EQ(report.joints[2].unit, "m");
  EXPECT_TRUE(report.notices.empty());
}

TEST(FilterGain, CountsNoOtherKernelAsAGain) {
  FilterRobots robots = threeTimes(plain().robot);
  robots.extended.effects.push_back({"backlash", 2, {{"half_width", 0.0}}});
  FilterGainOptions options;
  const FilterGainReport same = filterGain({plainEvidence()}, robots, options);
  options.one_kernel = false;
  const FilterGainReport own = filterGain({plainEvidence()}, robots, options);
  ASSERT_EQ(same.joints.size(), 3U);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(same.joints[j].extended, same.joints[j].nominal, 1e-3 * same.joints[j].nominal) << j;
    EXPECT_EQ(own.joints[j].extended, same.joints[j].extended);
  }
  EXPECT_EQ(nominalOf(own), nominalOf(filterGain({plainEvidence()}, threeTimes(plain().robot))));
}

TEST(FilterGain, TakesTheEncodersAsReferenceAlone) {
  const FilterRobots robots = threeTimes(plain().robot);
  const Evidence evidence = plainEvidence();
  Evidence moved = evidence;
  for (double& q : moved.q[1]) q += 0.5;
  const auto before = nominalOf(filterGain({evidence}, robots)),
             after = nominalOf(filterGain({moved}, robots));
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[2], before[2]);
  EXPECT_NEAR(after[1], 0.5, before[1]);
  FilterGainOptions options;
  options.zero_per_recording = true;
  const auto about_mean = nominalOf(filterGain({evidence, evidence}, robots, options)),
             about_others = nominalOf(filterGain({moved, evidence}, robots, options));
  EXPECT_LE(about_mean[1], before[1]);
  EXPECT_NEAR(about_others[1], about_mean[1], 1e-9);
}

TEST(FilterGain, LeavesRowsInDoubtAndReadingsThatAreMissingOut) {
  const FilterRobots robots = threeTimes(plain().robot);
  Evidence doubted = plainEvidence(), missing = doubted;
  for (std::size_t i = 2000; i < 3000; ++i) {
    doubted.exclusions[i] = kSaturated;
    for (std::size_t j = 0; j < 3; ++j) {
      doubted.q[j][i] += 1.0;
      missing.q[j][i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  const auto numbers = nominalOf(filterGain({doubted}, robots));
  EXPECT_EQ(numbers, nominalOf(filterGain({missing}, robots)));
  EXPECT_LT(numbers[0], 0.1);
  EXPECT_GT(numbers[0], 0.0);
}

TEST(FilterGain, IsTheSameWithAnyNumberOfThreads) {
  const Evidence evidence = plainEvidence();
  FilterGainOptions one, four;
  one.threads = 1, four.threads = 4;
  EXPECT_EQ(nominalOf(filterGain({evidence, evidence}, threeTimes(plain().robot), one)),
            nominalOf(filterGain({evidence, evidence}, threeTimes(plain().robot), four)));
}

/// Cameras whose stamps are early or late: the robot that knows it tracks as with punctual cameras.
class FilterGainWithClock : public ::testing::TestWithParam<double> {};

TEST_P(FilterGainWithClock, FollowsCamerasThatTheRobotSaysAreOff) {
  const double delay = GetParam();
  const Evidence evidence = plainEvidence();
  Evidence stamped = evidence;
  for (TipObservation& observation : stamped.tip) observation.t += delay;
  FilterRobots robots = threeTimes(plain().robot);
  robots.extended.effects.push_back({"camera_latency", 0, {{"delay", delay}}});
  FilterGainOptions trusting;  // of cameras: else stiff cables say all
  trusting.tracking.registration_rotation_sigma = trusting.tracking.registration_shift_sigma = 0.0;
  trusting.tracking.camera_clock_sigma = 0.0;
  trusting.tracking.tip_sigma.setConstant(5e-4);
  const FilterGainReport punctual = filterGain({evidence}, threeTimes(plain().robot), trusting),
                         off = filterGain({stamped}, robots, trusting);
  ASSERT_EQ(off.joints.size(), 3U);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_NEAR(off.joints[j].extended, punctual.joints[j].nominal, 0.2 * punctual.joints[j].nominal) << j;
  double worse = 0.0;
  for (const FilterGain& one : off.joints) worse = std::max(worse, one.nominal / one.extended);
  EXPECT_GT(worse, 1.01);
}

INSTANTIATE_TEST_SUITE_P(Delays, FilterGainWithClock, ::testing::Values(-0.1, 0.1, 0.4));

TEST(FilterGain, SaysWhichRecordingsItCannotUse) {
  Evidence blind = plainEvidence(), bare = blind;
  blind.title = "blind.csv", bare.title = "bare.csv";
  blind.tip.clear();
  bare.q.clear();
  const FilterRobots robots = threeTimes(plain().robot);
  const FilterGainReport none = filterGain({blind, bare}, robots);
  EXPECT_TRUE(none.joints.empty());
  ASSERT_EQ(none.notices.size(), 2U);
  EXPECT_NE(none.notices[0].find("blind.csv: no cameras"), std::string::npos) << none.notices[0];
  EXPECT_NE(none.notices[1].find("bare.csv: no joint encoders"), std::string::npos) << none.notices[1];
  const FilterGainReport some = filterGain({blind, plainEvidence()}, robots);
  EXPECT_EQ(some.notices.size(), 1U);
  EXPECT_EQ(nominalOf(some), nominalOf(filterGain({plainEvidence()}, robots)));
}

TEST(FilterGain, WarnsOfARobotThatMakesAnEstimateWorse) {
  const auto warnings = [](const robot::Description& extended) {
    const FilterGainReport report = filterGain({plainEvidence()}, {plain().robot, plain().robot, extended});
    return std::ranges::count_if(report.notices, [](const std::string& notice) {
      return notice.find("error of q1") != std::string::npos && notice.find("larger") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings(plain().robot), 0);
  robot::Description worse = plain().robot;
  worse.effects.push_back({"pulley_radius", 1, {{"share", 0.05}}});
  EXPECT_EQ(warnings(worse), 1);
}

TEST(FilterGain, SaysWhichRobotsItCannotFollow) {
  const auto noticeFor = [](const robot::Description& robot) {
    const FilterGainReport report = filterGain({plainEvidence()}, threeTimes(robot));
    EXPECT_TRUE(report.joints.empty());
    return report.notices.size() == 1 ? report.notices[0] : std::string();
  };
  robot::Description rigid = raven(), elbow = raven();
  rigid.drive = robot::DriveType::kRigid;
  elbow.joints[1].dh.a = 0.1;
  EXPECT_NE(noticeFor(rigid).find("cable-driven"), std::string::npos);
  robot::Description one = jaw();
  one.drive = robot::DriveType::kCable;
  EXPECT_NE(noticeFor(one).find("this one has 1"), std::string::npos);
  EXPECT_NE(noticeFor(elbow).find("remote-centre"), std::string::npos) << noticeFor(elbow);
}

TEST(FilterGain, StopsWhenCancelled) {
  base::Progress progress;
  progress.cancel();
  const FilterGainReport report = filterGain({plainEvidence()}, threeTimes(plain().robot), {}, &progress);
  EXPECT_TRUE(report.cancelled);
  EXPECT_TRUE(report.joints.empty());
}

TEST(FilterGain, IsPartOfADiagnosisThatShows) {
  const std::vector<Evidence> evidence = {plainEvidence()};
  DiagnosisOptions options;
  options.only = {"pulley_radius"};
  const Report shown = diagnose(evidence, plain().robot, options);
  const FilterGainReport own = filterGain(evidence, {plain().robot, shown.refitted, shown.extended});
  ASSERT_EQ(shown.filter.size(), 3U);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(shown.filter[j].nominal, own.joints[j].nominal);
    EXPECT_EQ(shown.filter[j].refitted, own.joints[j].refitted);
    EXPECT_EQ(shown.filter[j].extended, own.joints[j].extended);
  }
  EXPECT_EQ(shown.stages.back().name, "filter");
  options.filter = false;
  EXPECT_TRUE(diagnose(evidence, plain().robot, options).filter.empty());
}

}  // namespace
}  // namespace capstan::diagnosis
