// What it is worth to the filter to know a robot's effects: the plant has them, the filter's robot file does
// or does not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <variant>
#include <vector>

#include "core/robot/arm_kinematics.h"
#include "core/simulation/simulated_source.h"
#include "core/tracking/pipeline.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

using Eigen::Vector3d;

struct Planted {
  robot::Effect effect;
  double gain;  ///< by which the filter that knows it must be better at its joint
};

std::ostream& operator<<(std::ostream& out, const Planted& planted) { return out << planted.effect.effect; }

struct Errors {
  Vector3d joints = Vector3d::Zero();  ///< RMS [rad, rad, m]
  double tip = 0.0;                    ///< RMS [m]
};

/// Ten seconds of the truth's robot with real encoders and noisy markers, in which the camera sees the tip
/// two seconds of four.
std::vector<tracking::Sample> record(const robot::Description& robot) {
  SimulatedOptions options = quietOptions(10.0);
  options.robot = robot;
  options.truth = matchedTruth();
  options.rig = testRig();
  options.images = false;
  SimulatedSource source(options);
  std::vector<tracking::Sample> samples;
  for (tracking::Sample sample; source.next(sample);) {
    const auto* tip = std::get_if<tracking::TipSample>(&sample);
    if (tip == nullptr || std::fmod(tip->t, 4.0) < 2.0) samples.push_back(sample);
  }
  return samples;
}

Errors errorsOf(const std::vector<tracking::Sample>& samples, const robot::Description& known) {
  tracking::TrackingPipeline pipeline(known, std::nullopt, {}, {});
  const robot::ArmKinematics arm(known);
  Vector3d squares = Vector3d::Zero();
  double tip = 0.0;
  int count = 0;
  for (const tracking::Sample& sample : samples) {
    const tracking::Snapshot& now = pipeline.step(sample);
    if (!now.reference_paired || now.t < 0.5) continue;
    squares += (now.q_link_ukf - now.q_link_true).cwiseAbs2();
    tip += (arm.tip(now.q_link_ukf) - arm.tip(now.q_link_true)).squaredNorm();
    ++count;
  }
  EXPECT_GT(count, 5000);
  return {(squares / count).cwiseSqrt(), std::sqrt(tip / count)};
}

class Known : public ::testing::TestWithParam<Planted> {};

INSTANTIATE_TEST_SUITE_P(
    Effects, Known,
    ::testing::Values(Planted{{"pulley_radius", 1, {{"share", 0.03}}}, 3.0},
                      Planted{{"capstan_eccentricity", 1, {{"sine", 4e-4}, {"cosine", -6e-4}}}, 3.0},
                      Planted{{"backlash", 2, {{"half_width", 8e-4}}}, 1.5},
                      Planted{{"cable_hysteresis", 2, {{"force", 20.0}, {"yield", 2e-4}}}, 1.2},
                      Planted{{"cable_creep", 2, {{"share", 4.0}, {"time_constant", 3.0}}}, 1.2},
                      Planted{{"slack", 2, {{"pretension", -8e-4}}}, 1.5},
                      Planted{{"load_friction", 3, {{"share", 0.5}}}, 1.2},
                      Planted{{"homing_offset", 2, {{"offset", 0.03}}}, 3.0},
                      Planted{{"zero_drift", 2, {{"drift", 0.03}, {"time_constant", 4.0}}}, 3.0},
                      Planted{{"encoder_slip", 1, {{"slip", 4.0}, {"time", 3.0}}}, 3.0}),
    [](const auto& planted) { return planted.param.effect.effect; });

TEST_P(Known, anEffectMakesTheFilterBetter) {
  robot::Description extended = raven();
  extended.effects = {GetParam().effect};
  const std::vector<tracking::Sample> samples = record(extended);
  const Errors nominal = errorsOf(samples, raven()), knowing = errorsOf(samples, extended);
  const int joint = GetParam().effect.joint - 1;
  fmt::print(
      "{:>20}: nominal {:.4f} deg {:.4f} deg {:.3f} mm, tip {:.3f} mm; extended {:.4f} deg {:.4f} deg "
      "{:.3f} mm, tip {:.3f} mm\n",
      GetParam().effect.effect, 57.29578 * nominal.joints[0], 57.29578 * nominal.joints[1],
      1e3 * nominal.joints[2], 1e3 * nominal.tip, 57.29578 * knowing.joints[0], 57.29578 * knowing.joints[1],
      1e3 * knowing.joints[2], 1e3 * knowing.tip);
  EXPECT_GT(nominal.joints[joint] / knowing.joints[joint], GetParam().gain);
  EXPECT_LE(knowing.tip, nominal.tip);
}

TEST(KnownEffect, ofNoSizeCostsNothing) {
  const std::vector<tracking::Sample> samples = record(raven());
  robot::Description extended = raven();
  extended.effects = {{"asymmetric_friction", 2, {{"share", 0.0}}}};
  const Errors nominal = errorsOf(samples, raven()), knowing = errorsOf(samples, extended);
  fmt::print("nominal {:.3g} {:.3g} {:.3g}, with an effect of no size {:.3g} {:.3g} {:.3g} [rad, rad, m]\n",
             nominal.joints[0], nominal.joints[1], nominal.joints[2], knowing.joints[0], knowing.joints[1],
             knowing.joints[2]);
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(knowing.joints[joint] / nominal.joints[joint], 1.1) << joint;
}

/// RMS of the tip that the cameras saw, against where it was at the exposure [m].
double cameraError(const std::vector<tracking::Sample>& samples, const robot::Description& known) {
  tracking::TrackingPipeline pipeline(known, std::nullopt, {}, {});
  const robot::ArmKinematics arm(known);
  double squares = 0.0;
  int count = 0;
  for (const tracking::Sample& sample : samples) {
    const tracking::Snapshot& now = pipeline.step(sample);
    if (!now.camera_updated || !now.q_link_true_cam.allFinite() || !now.tip_cam.allFinite()) continue;
    squares += (now.tip_cam - arm.tip(now.q_link_true_cam)).squaredNorm();
    ++count;
  }
  EXPECT_GT(count, 50);
  return std::sqrt(squares / count);
}

/// In a filter that trusts its cables cameras hardly matter: what they see is looked at itself.
TEST(KnownCameras, areUnderstood) {
  const double sound = cameraError(record(raven()), raven());
  const std::vector<std::vector<robot::Effect>> all = {
      {{"camera_latency", 0, {{"delay", 0.06}}}},
      {{"camera_rotation", 0, {{"x", 0.0}, {"y", 0.05}, {"z", 0.05}}}},
      {{"camera_offset", 0, {{"x", 3e-3}, {"y", -4e-3}, {"z", 0.0}}}},
      {{"camera_scale", 0, {{"share", 0.03}}}}};
  for (const std::vector<robot::Effect>& effects : all) {
    robot::Description extended = raven();
    extended.effects = effects;
    const std::vector<tracking::Sample> samples = record(extended);
    const double nominal = cameraError(samples, raven()), knowing = cameraError(samples, extended);
    fmt::print("{:>20}: the cameras' tip {:.3f} mm, extended {:.3f} mm\n", effects[0].effect, 1e3 * nominal,
               1e3 * knowing);
    EXPECT_GT(nominal, 1.5 * sound) << effects[0].effect;
    EXPECT_LT(knowing, 1.1 * sound) << effects[0].effect;
  }
}

}  // namespace
}  // namespace capstan::simulation
