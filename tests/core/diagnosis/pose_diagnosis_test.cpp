// What is wrong between kinematics (or command) and cameras, planted with numbers drawn from a seed.
#include "core/diagnosis/poses/pose_diagnosis.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "tests/core/diagnosis/data_folder.h"
#include "tests/core/diagnosis/sampled_poses.h"
#include "tests/support/folders.h"

namespace capstan::diagnosis {
namespace {

using testing::PoseWorld;

Eigen::Vector3d drawn(base::Random& random, double size) {
  Eigen::Vector3d v;
  for (double& x : v) x = (random.bits() % 2 ? 1.0 : -1.0) * random.uniform(0.4, 1.0) * size;
  return v;
}

PoseReport diagnosed(const PoseWorld& world, PoseReference towards = PoseReference::kKinematics) {
  PoseOptions options;
  options.towards = towards;
  options.show = false;
  return diagnosePoses(parsePoseEvidence(testing::poseTable(world), "made up"), raven(), options);
}

std::set<std::string> namesIn(const Report& report) {
  std::set<std::string> names;
  for (const Cause& cause : report.causes) names.insert(cause.effect);
  return names;
}

/// Within four sigmas of what was planted, which are no more than `most`.
void expectNumbers(const Report& report, const std::string& effect, const std::vector<double>& planted,
                   double most) {
  for (const Cause& cause : report.causes) {
    if (cause.effect != effect) continue;
    ASSERT_EQ(cause.parameters.size(), planted.size());
    for (std::size_t i = 0; i < planted.size(); ++i) {
      const FoundParameter& found = cause.parameters[i];
      EXPECT_NEAR(found.value, planted[i], 4.0 * found.sigma) << effect << " " << found.name;
      EXPECT_LT(found.sigma, most) << effect << " " << found.name;
      EXPECT_GT(found.sigma, 0.0) << effect << " " << found.name;
    }
    return;
  }
  ADD_FAILURE() << effect << " is not among the causes: " << report.summary;
}

std::vector<double> numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

TEST(PoseDiagnosis, NothingIsNamedWhereNothingIsWrong) {
  for (const std::uint64_t seed : {11, 12, 13, 14}) {
    const PoseReport found = diagnosed({.seed = seed});
    EXPECT_EQ(found.report.verdict, Verdict::kNothing) << seed << ": " << found.report.summary;
    EXPECT_TRUE(found.report.causes.empty());
    ASSERT_EQ(found.steps.size(), 1U);
    EXPECT_NEAR(found.steps[0].rms, std::sqrt(3.0) * 1e-4, 0.3e-4);
    EXPECT_EQ(found.fitted, 48U);
    EXPECT_EQ(found.held_out, 12U);
  }
}

TEST(PoseDiagnosis, RegistrationAndClock) {
  for (const std::uint64_t seed : {21, 22, 23}) {
    base::Random random(seed, "planted");
    PoseWorld world{.seed = seed};
    world.rotation = drawn(random, 0.08);
    world.offset = drawn(random, 0.01);
    world.delay = random.uniform(0.02, 0.06);
    const PoseReport found = diagnosed(world);
    EXPECT_EQ(found.report.verdict, Verdict::kSeveral) << found.report.summary;
    EXPECT_EQ(namesIn(found.report),
              (std::set<std::string>{"camera_latency", "camera_offset", "camera_rotation"}));
    expectNumbers(found.report, "camera_rotation", numbers(world.rotation), 2e-3);
    expectNumbers(found.report, "camera_offset", numbers(world.offset), 3e-4);
    expectNumbers(found.report, "camera_latency", {world.delay}, 1e-3);
    EXPECT_LT(found.steps.back().rms, 3e-4);
    EXPECT_GT(found.steps.front().rms, 4e-3);
    EXPECT_GT(found.report.explained, 0.99);
    EXPECT_EQ(found.report.extended.effects.size(), 3U + found.report.also_measurable.size())
        << "a robot file with the cameras as they are";
  }
}

TEST(PoseDiagnosis, PlayOfTheTipAndNoLag) {
  for (const std::uint64_t seed : {31, 32, 33}) {
    base::Random random(seed, "planted");
    PoseWorld world{.seed = seed};
    world.gap = drawn(random, 0.002).cwiseAbs();
    const PoseReport found = diagnosed(world);
    EXPECT_EQ(found.report.verdict, Verdict::kFound) << found.report.summary;
    expectNumbers(found.report, "tip_gap", numbers(world.gap), 1e-4);
    EXPECT_TRUE(found.report.extended.effects.empty()) << "no robot file knows it";
  }
}

TEST(PoseDiagnosis, ScaleAndMarkerOnTheTool) {
  for (const std::uint64_t seed : {41, 42, 43}) {
    base::Random random(seed, "planted");
    PoseWorld world{.seed = seed};
    world.scale = random.uniform(0.02, 0.05);
    world.marker = drawn(random, 0.008);
    const PoseReport found = diagnosed(world);
    EXPECT_EQ(namesIn(found.report), (std::set<std::string>{"camera_scale", "marker_offset"}));
    expectNumbers(found.report, "camera_scale", {world.scale}, 1e-3);
    expectNumbers(found.report, "marker_offset", numbers(world.marker), 2e-4);
  }
}

TEST(PoseDiagnosis, CommandsRunAheadOfATipThatItsKinematicsKnow) {
  const PoseWorld world{.seed = 51, .command_ahead = 0.08};
  const PoseReport command = diagnosed(world, PoseReference::kCommand);
  EXPECT_EQ(namesIn(command.report), (std::set<std::string>{"command_delay"})) << command.report.summary;
  expectNumbers(command.report, "command_delay", {world.command_ahead}, 1e-3);
  EXPECT_TRUE(command.report.extended.effects.empty());
  EXPECT_EQ(diagnosed(world).report.verdict, Verdict::kNothing);
}

TEST(PoseDiagnosis, SameTableSameReport) {
  PoseWorld world{.seed = 61};
  world.offset.x() = 0.003;
  EXPECT_EQ(jsonOf(diagnosed(world)).at("steps"), jsonOf(diagnosed(world)).at("steps"));
}

TEST(PoseDiagnosis, TellsStepsInJsonAndTable) {
  PoseWorld world{.seed = 71};
  world.offset.z() = -0.004;
  const PoseReport found = diagnosed(world);
  const nlohmann::json json = jsonOf(found);
  EXPECT_EQ(json.at("verdict"), "found");
  EXPECT_EQ(json.at("towards"), "kinematics");
  EXPECT_EQ(json.at("trajectories").at("held_out"), 12);
  ASSERT_EQ(json.at("steps").size(), 2U);
  EXPECT_TRUE(json.at("steps")[0].at("effect").is_null());
  EXPECT_NEAR(json.at("steps")[0].at("rms").get<double>(), 0.004, 1e-4);
  EXPECT_EQ(json.at("steps")[1].at("effect"), "camera_offset");
  EXPECT_EQ(json.at("channels").size(), 3U);
  const base::Table table = poseStepTable(found);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_NEAR(table.rows[0][1].number, 4.0, 0.1) << "millimetres";
}

TEST(PoseDiagnosis, EffectsBelowTheToleranceAreAlsoMeasurable) {
  PoseWorld world{.seed = 81};
  world.offset.x() = 0.001;
  PoseOptions options;
  options.towards = PoseReference::kKinematics;
  options.show = false;
  const PoseEvidence evidence = parsePoseEvidence(testing::poseTable(world), "made up");
  const Report found = diagnosePoses(evidence, raven(), options).report;
  ASSERT_EQ(found.causes.size(), 1U) << found.summary;
  EXPECT_NEAR(found.causes[0].moves.tip.rms, 0.001, 1e-4);
  options.material.length = 2e-4;  // cameras: ten times as much
  const Report below = diagnosePoses(evidence, raven(), options).report;
  EXPECT_EQ(below.verdict, Verdict::kNothing) << below.summary;
  EXPECT_TRUE(below.causes.empty());
  ASSERT_EQ(below.also_measurable.size(), 1U);
  EXPECT_EQ(below.also_measurable[0].effect, "camera_offset");
  EXPECT_EQ(below.also_measurable[0].parameters[0].value, found.causes[0].parameters[0].value);
}

TEST(PoseDiagnosis, AnEffectThatIsNamedTwiceIsOneCandidate) {
  PoseWorld world{.seed = 85};
  world.offset.x() = 0.003;
  PoseOptions options;
  options.show = false;
  options.only = {"camera_offset", "camera_offset"};
  const PoseReport found =
      diagnosePoses(parsePoseEvidence(testing::poseTable(world), "made up"), raven(), options);
  EXPECT_EQ(found.report.verdict, Verdict::kFound) << found.report.summary;
}

TEST(PoseDiagnosis, IsComparedWithRegressions) {
  PoseWorld world{.seed = 91};
  world.gap.setConstant(0.002);
  world.offset.y() = 0.005;
  const PoseReport found = diagnosePoses(parsePoseEvidence(testing::poseTable(world), "made up"), raven());
  ASSERT_EQ(found.report.explainable.size(), 3U);
  for (const Explainable& one : found.report.explainable) {
    EXPECT_LT(one.named, 0.5 * one.linear) << one.channel << ": play is not linear";
    EXPECT_LT(one.linear, one.refitted) << one.channel;
    EXPECT_LE(one.flexible, one.linear) << one.channel;
    EXPECT_GT(one.share, 0.95) << one.channel;
  }
  double sum = 0.0;
  for (const SetProbability& set : found.report.posterior) sum += set.probability;
  EXPECT_GT(sum, 0.95);
  EXPECT_LE(sum, 1.0 + 1e-9);
}

TEST(PoseDiagnosis, RefusesWhatItCannotAnswer) {
  const PoseEvidence few = parsePoseEvidence(testing::poseTable({.trajectories = 5}), "few.csv");
  try {
    diagnosePoses(few, raven());
    FAIL() << "five trajectories were taken";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "few.csv");
    EXPECT_NE(error.fault().reason.find("5 trajectories"), std::string::npos) << error.what();
  }
  PoseOptions options;
  options.only = {"backlash"};
  const PoseEvidence enough = parsePoseEvidence(testing::poseTable({}), "enough.csv");
  try {
    diagnosePoses(enough, raven(), options);
    FAIL() << "poses show no backlash of a joint";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().value, "backlash");
    EXPECT_NE(error.fault().remedy.find("tip_gap"), std::string::npos) << error.what();
  }
}

/// The arm of Mahler et al., CASE 2014. Nobody knows its truth; what is held here is what two ways of asking
/// must agree on: the cameras' registration and marker, which the reference does not change, and a command
/// that lags behind kinematics that do not.
TEST(PoseDiagnosis, MeasuredArm) {
  const std::filesystem::path file = dataFolder() / "raven2-phasespace" / "left_arm.csv";
  REQUIRE_DATA(file);
  const PoseEvidence evidence = readPoseEvidence(file);
  EXPECT_EQ(evidence.trajectories.size(), 243U);
  EXPECT_EQ(evidence.command.placeholders, 339U);
  EXPECT_GT(evidence.camera.repeats, 2000U);
  EXPECT_LT(evidence.camera.outliers, 200U);
  PoseOptions options;
  options.show = false;
  const PoseReport kinematics = diagnosePoses(evidence, raven(), options);
  const auto names = namesIn(kinematics.report);
  for (const char* name : {"camera_offset", "camera_rotation", "marker_offset"})
    EXPECT_TRUE(names.contains(name)) << name << ": " << kinematics.report.summary;
  EXPECT_FALSE(names.contains("camera_latency")) << kinematics.report.summary;
  EXPECT_GT(kinematics.steps.front().rms, 20e-3);
  EXPECT_LT(kinematics.steps.back().interval.high, 4e-3);
  options.towards = PoseReference::kCommand;
  options.only = {"camera_offset", "camera_rotation", "marker_offset", "command_delay"};
  const PoseReport command = diagnosePoses(evidence, raven(), options);
  EXPECT_TRUE(namesIn(command.report).contains("command_delay")) << command.report.summary;
  EXPECT_GT(command.steps.back().rms, kinematics.steps.back().rms);
  const auto turnOf = [](const PoseReport& report) {
    for (const Cause& cause : report.report.causes)
      if (cause.effect == "camera_rotation")
        return Eigen::Vector3d(cause.parameters[0].value, cause.parameters[1].value,
                               cause.parameters[2].value);
    return Eigen::Vector3d(1.0, 1.0, 1.0);
  };
  EXPECT_LT((turnOf(command) - turnOf(kinematics)).norm(), 0.06);
}

}  // namespace
}  // namespace capstan::diagnosis
