// How far an effect moves joints and tip: a joint that was homed at another position is off by that constant.
#include "core/diagnosis/selection/displacement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/robot/kinematics.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

/// RMS distance of the tip from where it would be with one joint `offset` further back, at the encoders'
/// positions.
double tipMovedBy(const robot::Description& robot, const Evidence& evidence, Eigen::Index joint,
                  double offset) {
  const robot::Chain chain(robot);
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < evidence.rows(); k += 10) {
    robot::JointVector q(evidence.joints);
    for (Eigen::Index j = 0; j < q.size(); ++j) q[j] = evidence.q[static_cast<std::size_t>(j)][k];
    robot::JointVector back = q;
    back[joint] -= offset;
    const double moved = (chain.marker(q) - chain.marker(back)).norm();
    if (!std::isfinite(moved)) continue;
    sum += moved * moved, count += 1.0;
  }
  return std::sqrt(sum / count);
}

/// The nominal robot, homed at another position at joint `joint`.
Fit homedAt(const FitData& data, const Planted& planted, int joint, double offset) {
  const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
  const FitModel model =
      nominal.with(*hypothesisNamed("homing_offset"), joint, {{offset, 0.0}, {std::abs(offset), 0.0}});
  return linearise(data, model, Eigen::VectorXd::Zero(model.size()), noneBeyond(data),
                   {Eigen::VectorXd::Ones(data.size())});
}

TEST(Displacement, OfAHomingOffsetIsTheOffset) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const EffectCandidate effect{hypothesisNamed("homing_offset"), 2};
  for (const double offset : {0.01, -0.002}) {
    const Displacements moves =
        displacementsBy(data, homedAt(data, planted, 2, offset), effect, planted.robot);
    ASSERT_EQ(moves.joints.size(), 3U);
    EXPECT_NEAR(moves.joints[1].rms, std::abs(offset), 0.05 * std::abs(offset));
    EXPECT_GE(moves.joints[1].largest, moves.joints[1].rms);
    EXPECT_FALSE(moves.joints[0].slides);
    EXPECT_FALSE(moves.joints[1].slides);
    EXPECT_TRUE(moves.joints[2].slides);
    EXPECT_TRUE(moves.tip.slides);
    const double tip = tipMovedBy(planted.robot, planted.evidence.front(), 1, offset);
    EXPECT_NEAR(moves.tip.rms, tip, 0.1 * tip);
    EXPECT_TRUE(isMaterial(moves, {0.5 * std::abs(offset), 1.0}));
    EXPECT_FALSE(isMaterial(moves, {5.0 * std::abs(offset), 1.0}));
  }
}

/// A softer cable of joint 2 moves joint 2 and hardly the others; a parameter at its nominal value moves
/// nothing.
TEST(Displacement, OfARefittedParameterIsThatOfItsChange) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const FitModel model(planted.robot, jointScales(planted.evidence, planted.robot));
  int stiffness = -1, friction = -1;
  for (int k = 0; k < model.baseSize(); ++k) {
    const FitParameter& one = model.parameters()[static_cast<std::size_t>(k)];
    if (one.name == "cable_stiffness" && one.joint == 2) stiffness = k;
    if (one.name == "coulomb" && one.joint == 1) friction = k;
  }
  ASSERT_GE(stiffness, 0);
  ASSERT_GE(friction, 0);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.size());
  const FitParameter& soft = model.parameters()[static_cast<std::size_t>(stiffness)];
  u[stiffness] = soft.u(0.5 * soft.start);
  const Fit fit = linearise(data, model, u, noneBeyond(data), {Eigen::VectorXd::Ones(data.size())});
  const auto moves = displacementsByRefit(data, fit, {stiffness, friction}, planted.robot);
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_GT(moves[0].joints[1].rms, 1e-5);
  EXPECT_GT(moves[0].joints[1].rms, 5.0 * moves[0].joints[0].rms);
  EXPECT_GT(moves[0].tip.rms, 0.0);
  EXPECT_TRUE(isMaterial(moves[0], {0.5 * moves[0].joints[1].rms, 1.0}));
  EXPECT_EQ(moves[1].joints[1].largest, 0.0) << "it is at its nominal value";
  EXPECT_FALSE(isMaterial(moves[1], {}));
}

/// What only cameras get wrong moves the tip that they see, and no joint.
TEST(Displacement, OfCamerasIsOfTheTipAlone) {
  const Planted planted(1);
  ASSERT_TRUE(planted.evidence.front().hasCameras());
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const EffectCandidate effect{hypothesisNamed("camera_offset"), 0};
  const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
  const FitModel model = nominal.with(*effect.hypothesis, 0, {{2e-3, -1e-3, 2e-3}, {1e-3, 1e-3, 1e-3}});
  const Fit fit = linearise(data, model, Eigen::VectorXd::Zero(model.size()), noneBeyond(data),
                            {Eigen::VectorXd::Ones(data.size())});
  const Displacements moves = displacementsBy(data, fit, effect, planted.robot);
  for (const Displacement& joint : moves.joints) EXPECT_EQ(joint.largest, 0.0);
  EXPECT_NEAR(moves.tip.rms, 3e-3, 1e-9);
  EXPECT_NEAR(moves.tip.largest, 3e-3, 1e-9);
  EXPECT_TRUE(isMaterial(moves, {1.0, 2e-4}));  // cameras: ten times the length
  EXPECT_FALSE(isMaterial(moves, {1.0, 4e-4}));
}

TEST(Displacement, OfAnEffectWithoutSizeIsNone) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
  const EffectCandidate effect{hypothesisNamed("homing_offset"), 2};
  const FitModel model = nominal.with(*effect.hypothesis, 2, {{0.0, 0.0}, {0.01, 0.0}});
  const Fit fit = linearise(data, model, Eigen::VectorXd::Zero(model.size()), noneBeyond(data),
                            {Eigen::VectorXd::Ones(data.size())});
  const Displacements moves = displacementsBy(data, fit, effect, planted.robot);
  for (const Displacement& joint : moves.joints) EXPECT_LT(joint.largest, 1e-12);
  EXPECT_LT(moves.tip.largest, 1e-12);
  EXPECT_FALSE(isMaterial(moves, {}));
}

}  // namespace
}  // namespace capstan::diagnosis
