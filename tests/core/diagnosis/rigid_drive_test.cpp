// Rigid drives, whose friction sticks: fits that get where a linearisation alone does not lead.
#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/horizons.h"
#include "tests/support/folders.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

/// An axis that moves slowly enough to stick, with an effect.
struct Sticking {
  robot::Description robot =
      robot::readDescription(test::sourceFile("tests/support/planted/data/rigid_axis.yaml"));
  test::Truth truth;
  std::vector<Evidence> evidence;

  explicit Sticking(test::Effect effect = test::Effect::kStribeckFriction, double size = 0.23,
                    bool encoders = true) {
    robot.drive = robot::DriveType::kRigid;
    test::DrawOptions options;
    options.robot = robot;
    options.rigid = true;
    options.effect = effect;
    options.size = size;
    options.sensors.joint_encoders = encoders;
    options.textured = false;
    options.duration = 20.0;
    auto [recording, measured] = test::recordWithTruth(test::draw(30003012, options));
    truth = measured;
    evidence.push_back(evidenceOf(recording.table, robot));
  }

  Fit refitted(const FitData& data) const {
    SearchOptions options;
    options.most_causes = 0;
    return select(data, evidence, FitModel(robot, jointScales(evidence, robot)), nullptr, options, nullptr)
        .base;
  }
};

TEST(RigidDrive, WhatAFitLeavesIsWhatIsSimulatedFromItsInitialStates) {
  const Sticking sticking;
  const FitData data(sticking.evidence, sticking.robot, kHorizons[1], EncoderZeros::kKnown, 2);
  const Fit fit = sticking.refitted(data);
  const Eigen::VectorXd simulated =
      data.measured() - data.simulate({fit.model.chain(fit.u)}, {fit.initial}).col(0);
  EXPECT_LT((simulated - fit.e).norm(), 0.1 * fit.e.norm());
}

TEST(RigidDrive, FindsWhyItSticks) {
  const Sticking sticking;
  DiagnosisOptions options;
  options.show = false;
  options.material = {1e-7, 1e-7};  // what is found, however small
  const Report report = diagnose(sticking.evidence, sticking.robot, options);
  EXPECT_EQ(report.verdict, Verdict::kFound);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes[0].effect, "stribeck_friction");
  const FoundParameter& excess = report.causes[0].parameters.at(0);
  const double planted = sticking.truth.items.at(0).planted.magnitude;
  EXPECT_NEAR(excess.value, planted, 0.05 * planted);
}

TEST(RigidDrive, IsDiagnosedFromCamerasAlone) {
  const Sticking sticking(test::Effect::kPositionFriction, 0.9, false);
  ASSERT_FALSE(sticking.evidence[0].hasEncoders());
  DiagnosisOptions options;
  options.show = false;
  options.material = {1e-7, 1e-7};  // what is found, however small
  const Report report = diagnose(sticking.evidence, sticking.robot, options);
  EXPECT_EQ(report.verdict, Verdict::kFound);
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes[0].effect, "position_friction");
}

/// Whose blocks average to zero, since each has initial states of its own.
TEST(RigidDrive, FarBeyondNoiseIsNeverNothing) {
  const Sticking sticking(test::Effect::kStribeckFriction, 0.9);
  DiagnosisOptions options;
  options.show = false;
  options.material = {1e-7, 1e-7};  // what is found, however small
  options.only = {"torque_offset"};
  EXPECT_EQ(diagnose(sticking.evidence, sticking.robot, options).verdict, Verdict::kUnexplained);
}

}  // namespace
}  // namespace capstan::diagnosis
