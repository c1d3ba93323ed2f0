// The planted robot as a whole: energy, integration, sensors, recordings.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/support/folders.h"
#include "tests/support/planted/excitation.h"
#include "tests/support_tests/planted_robots.h"

namespace capstan::test {
namespace {

robot::Description withoutLosses(robot::Description robot) {
  for (robot::Joint& joint : robot.joints) joint.friction.coulomb = joint.friction.viscous = 0.0;
  for (robot::Drive& drive : robot.drives) {
    drive.cable_damping = 0.0;
    drive.motor_friction.coulomb = drive.motor_friction.viscous = 0.0;
  }
  return robot;
}

/// Energy after a second in which a constant torque pushed the motors, less the work that it did [J].
double energyGained(const robot::Description& robot, bool rigid, const Joints& q, const Joints& torque) {
  Plant plant(PlantParameters(robot, rigid), {});
  PlantState s = plant.rest(q);
  const double before = plant.energy(s);
  const Joints motors = rigid ? plant.motorsAt(s[kJoint]) : s[kMotor];
  PlantInput input;
  input.torque = torque;
  const int steps = 2 * plant.stepsFor(1e-3, q);
  for (int k = 0; k < 1000; ++k) plant.advance(s, k * 1e-3, 1e-3, steps, input);
  const Joints motors_after = rigid ? plant.motorsAt(s[kJoint]) : s[kMotor];
  double work = 0.0, moved = 0.0;
  for (int i = 0; i < plant.size(); ++i) {
    work += torque[i] * (motors_after[i] - motors[i]);
    moved = std::max(moved, std::abs(s[kJointRate][i]));
  }
  EXPECT_GT(moved, 0.05);
  return plant.energy(s) - before - work;
}

TEST(PlantedRobot, KeepsEnergyWithoutFriction) {
  const robot::Description free = withoutLosses(raven());
  EXPECT_NEAR(energyGained(free, false, {0.7, 1.5, 0.4}, {}), 0.0, 1e-7);
  EXPECT_NEAR(energyGained(free, false, {0.7, 1.5, 0.4}, {0.01, -0.01, 0.02}), 0.0, 1e-6);
  const robot::Description arm = withoutLosses(rigidRobot("rigid_arm"));
  EXPECT_NEAR(energyGained(arm, true, {0.2, 0.6, -0.5}, {}), 0.0, 1e-7);
  EXPECT_NEAR(energyGained(arm, true, {0.2, 0.6, -0.5}, {0.2, -0.3, 0.1}), 0.0, 1e-7);
}

TEST(PlantedRobot, StandsAtRestUnderGravity) {
  for (const bool rigid : {false, true}) {
    const robot::Description robot = rigid ? rigidRobot("rigid_arm") : raven();
    Plant plant(PlantParameters(robot, rigid), {});
    const Joints q{0.5, rigid ? 0.0 : 1.5, rigid ? 0.0 : 0.4};
    PlantState s = plant.rest(q);
    PlantInput input;
    const Joints motors = s[kMotor], still{};
    input.motor = input.motor_end = &motors;
    input.motor_rate = input.motor_rate_end = &still;
    for (int k = 0; k < 500; ++k) plant.advance(s, 0.0, 1e-3, plant.stepsFor(1e-3, q), input);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(s[kJoint][i], q[i], 1e-6);
  }
}

/// A case of one effect on the RAVEN-II, or on a rigid arm where cables have no such effect.
PlantedCase caseOf(Effect effect, double size, double duration) {
  const bool rigid = !factsOf(effect).cable;
  DrawOptions options = optionsFor(rigid ? rigidRobot("rigid_arm") : raven(), rigid);
  options.effect = effect;
  options.size = size;
  options.textured = true;
  options.duration = duration;
  return draw(11, options);
}

/// Open loop over the same motors, so that no encoder count turns a rounding into another control action;
/// every effect as large as is plausible.
TEST(PlantedRobot, HalvingTheStepChangesNothingThatMatters) {
  for (const EffectFacts& facts : allEffects()) {
    if (facts.place == Place::kCamera || facts.place == Place::kSensor) continue;
    const PlantedCase one = caseOf(facts.effect, 1.0, 2.0);
    PlantParameters p(one.robot, one.rigid);
    base::Random random(2);
    const int joint = std::max(one.effects.front().joint - 1, 0);
    const std::vector<Planted> effects = {largestPlausible(facts.effect, joint, p, one.robot, random)};
    plantInParameters(effects.front(), one.robot, p);
    const Excitation excitation(one.robot, one.duration, random);
    Plant coarse(p, effects);
    const PlantedMotion first = drive(
        coarse, one.robot, effects, [&](double t) { return excitation.at(t); },
        [](double) { return Joints{}; }, {one.duration, 0.2});
    const PlantedMotion wide = replay(coarse, first, effects);
    p.refinement = 2;
    Plant fine(p, effects);
    const PlantedMotion narrow = replay(fine, first, effects);
    for (int i = 0; i < one.robot.size(); ++i) {
      double worst = 0.0;
      for (std::size_t k = 0; k < wide.q.size(); ++k)
        worst = std::max(worst, std::abs(wide.q[k][i] - narrow.q[k][i]));
      const bool turns = one.robot.joints[static_cast<std::size_t>(i)].type == robot::JointType::kRevolute;
      const double count = turns ? one.sensors.turn_count : one.sensors.slide_count;
      EXPECT_LT(worst, 0.05 * count) << facts.name << " joint " << i + 1;
    }
  }
}

double spreadOf(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const double x : values) {
    if (std::isnan(x)) continue;
    sum += x;
    squares += x * x;
    count += 1.0;
  }
  return std::sqrt(squares / count - sum * sum / (count * count));
}

/// To the last bit, empty cells too.
bool sameBytes(const recording::MeasuredTable& a, const recording::MeasuredTable& b) {
  using recording::MeasuredTable;
  for (const auto columns : {&MeasuredTable::q_m, &MeasuredTable::dq_m, &MeasuredTable::tau_m,
                             &MeasuredTable::q, &MeasuredTable::p_c, &MeasuredTable::tau_ext}) {
    if ((a.*columns).size() != (b.*columns).size()) return false;
    for (std::size_t i = 0; i < (a.*columns).size(); ++i) {
      const auto &left = (a.*columns)[i], &right = (b.*columns)[i];
      if (left.size() != right.size()) return false;
      if (std::memcmp(left.data(), right.data(), left.size() * sizeof(double)) != 0) return false;
    }
  }
  return a.t == b.t;
}

TEST(PlantedRecording, AnEffectOfSizeZeroIsNoneAndALargeOneIsSeen) {
  for (const EffectFacts& facts : allEffects()) {
    // Loads change their sign in no time shorter than this.
    PlantedCase none = caseOf(facts.effect, 0.0, facts.effect == Effect::kSensorSign ? 12.0 : 1.5);
    if (facts.effect == Effect::kSensorSign) none.load[none.effects.front().joint - 1] = 0.4;
    PlantedCase large = none, without = none;
    large.effects.front().size = 1e6;  // the largest plausible
    without.effects.clear();
    const recording::MeasuredTable plain = record(without).table;
    EXPECT_TRUE(sameBytes(record(none).table, plain)) << facts.name;
    EXPECT_FALSE(sameBytes(record(large).table, plain)) << facts.name;
  }
}

TEST(PlantedRecording, SameSeedSameBytes) {
  const PlantedCase drawn = caseOf(Effect::kBacklash, 0.5, 2.0);
  EXPECT_TRUE(sameBytes(record(drawn).table, record(drawn).table));
  PlantedCase other = drawn;
  other.seed += 1;
  EXPECT_NE(record(drawn).table.q, record(other).table.q);
}

TEST(PlantedRecording, SensorsCountAndPicturesComeAtTheirRate) {
  PlantedCase plain = caseOf(Effect::kBacklash, 0.0, 6.0);
  const recording::MeasuredTable table = record(plain).table;
  ASSERT_EQ(table.rows(), 6001U);
  ASSERT_EQ(table.joints(), 3);
  EXPECT_EQ(table.file, "recording");
  const auto counts = [](double value, double count) {
    return std::abs(value / count - std::round(value / count));
  };
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    EXPECT_NEAR(table.t[k], 1e-3 * static_cast<double>(k), 1e-12);
    EXPECT_LT(counts(table.q_m[1][k], 2.0 * std::numbers::pi / 4000.0), 1e-6);
    EXPECT_LT(counts(table.q[0][k], 2.0 * std::numbers::pi / 80000.0), 1e-6);
    EXPECT_LT(counts(table.q[2][k], 5e-6), 1e-6);
    if (!std::isnan(table.p_c[0][k])) frames.push_back(k);
  }
  EXPECT_NEAR(static_cast<double>(frames.size()), 6.0 * 15.0, 2.0);
  EXPECT_LE(frames.back(), 5960U);
  for (std::size_t k = 1; k < frames.size(); ++k)
    EXPECT_NEAR(static_cast<double>(frames[k] - frames[k - 1]), 66.5, 0.6);
}

TEST(PlantedRecording, CamerasErrMostInDepthAsTheirGeometrySays) {
  SensorOptions options;
  const Eigen::Vector3d middle(0.1, -0.1, 0.0);
  const StereoPair cameras(middle, options);
  base::Random random(4);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kPictures = 4000;
  for (int k = 0; k < kPictures; ++k) {
    const Eigen::Vector3d error = cameras.see(middle, random) - middle;
    mean += error / kPictures;
    spread += error * error.transpose() / kPictures;
  }
  EXPECT_LT(mean.norm(), 4.0 * cameras.sigma() / std::sqrt(kPictures));
  EXPECT_NEAR(std::sqrt(spread.trace()), cameras.sigma(), 0.05 * cameras.sigma());
  const Eigen::Vector3d along = Eigen::Vector3d(0.35, -0.45, 0.82).normalized();
  const double depth =
      0.55 * 0.55 / (650.0 * 0.048) * std::sqrt(2.0) * 0.04;  // z²/(f b) times disparity noise
  EXPECT_NEAR(std::sqrt(along.dot(spread * along)), depth, 0.05 * depth);
}

/// `n` joints, every axis across the one before; light links on stout cables.
robot::Description chainOf(int n) {
  robot::Description robot;
  robot.name = "chain";
  robot.gravity = {0.0, 0.0, -9.81};
  robot.marker = {0.1, 0.0, 0.0};
  for (int i = 0; i < n; ++i) {
    robot::Joint joint;
    joint.name = std::to_string(i + 1);
    joint.dh = {i % 2 == 0 ? 0.0 : 1.5707963267948966, i == 0 ? 0.0 : 0.12, 0.0, 0.0};
    joint.limit_low = -0.8;
    joint.limit_high = 0.8;
    joint.max_speed = 1.0;
    joint.link = {0.2, {0.06, 0.0, 0.0}, {1e-4, 4e-4, 4e-4}};
    joint.friction = {0.05, 0.02, 0.01};
    robot.joints.push_back(joint);
    robot.drives.push_back({20.0, 5e-3, 0.03, 5e4, 300.0, 1.0, 1e-4, {5e-3, 1e-4, 0.5}, 2.0, 4000.0});
    robot.coupling.emplace_back(static_cast<std::size_t>(n), 0.0);
    robot.coupling.back()[static_cast<std::size_t>(i)] = 1.0;
    if (i > 0) robot.coupling.back()[static_cast<std::size_t>(i - 1)] = 0.2;
  }
  return robot;
}

/// What its controller was requested is what a robot of any length does, but for stretch and latency.
TEST(PlantedRecording, ChainsOfOneToSevenJointsFollowTheirController) {
  for (int n = 1; n <= 7; ++n)
    for (const bool rigid : {false, true}) {
      PlantedCase plain;
      plain.seed = 3;
      plain.robot = chainOf(n);
      plain.rigid = rigid;
      plain.duration = 2.0;
      const recording::MeasuredTable table = record(plain).table;
      ASSERT_EQ(table.joints(), n);
      base::Random way(plain.seed, "excitation");
      const Excitation desired(plain.robot, plain.duration, way);
      for (int i = 0; i < n; ++i) {
        const auto& q = table.q[static_cast<std::size_t>(i)];
        double worst = 0.0;
        for (std::size_t k = 0; k < q.size(); ++k)
          worst = std::max(worst, std::abs(q[k] - desired.at(table.t[k])[static_cast<std::size_t>(i)]));
        EXPECT_LT(worst, 0.06) << n << (rigid ? " rigid" : " cable") << " joint " << i + 1;
        EXPECT_GT(spreadOf(q), 1e-3);
      }
    }
}

TEST(PlantedRobot, ARobotThatIsTooStiffIsRefused) {
  robot::Description robot = slider();
  robot.joints[0].friction = {5.0, 0.0, 1e-7};  // 2.5e7 1/s about rest
  Plant plant(PlantParameters(robot, false), {});
  EXPECT_THROW(plant.stepsFor(1e-3, Joints{}), std::invalid_argument);
}

TEST(PlantedRecording, SensorsThatAreAbsentLeaveNoColumns) {
  PlantedCase plain = caseOf(Effect::kBacklash, 0.0, 0.5);
  plain.sensors = {};
  plain.sensors.motor_velocity = plain.sensors.motor_torque = false;
  plain.sensors.joint_encoders = plain.sensors.cameras = false;
  const recording::MeasuredTable table = record(plain).table;
  EXPECT_FALSE(table.q_m.empty());
  EXPECT_TRUE(table.dq_m.empty() && table.tau_m.empty() && table.q.empty() && table.p_c.empty());
  EXPECT_TRUE(table.tau_ext.empty());
}

/// Ranges, speeds and torques of the order of recordings that somebody else's simulator made.
TEST(PlantedRecording, LooksLikeRecordingsMadeElsewhere) {
  const auto path = sharedFile("data") / "plant" / "rec101.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const recording::MeasuredTable theirs = recording::readMeasuredTable(path);
  PlantedCase plain = caseOf(Effect::kBacklash, 0.0, 40.0);
  const recording::MeasuredTable ours = record(plain).table;
  const auto alike = [](const recording::TableColumns& a, const recording::TableColumns& b,
                        const char* what) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double ratio = spreadOf(a[i]) / spreadOf(b[i]);
      EXPECT_GT(ratio, 1.0 / 3.0) << what << i + 1;
      EXPECT_LT(ratio, 3.0) << what << i + 1;
    }
  };
  alike(ours.q_m, theirs.q_m, "q_m");
  alike(ours.dq_m, theirs.dq_m, "dq_m");
  alike(ours.tau_m, theirs.tau_m, "tau_m");
  alike(ours.q, theirs.q, "q");
  alike(ours.p_c, theirs.p_c, "p_c");
}

}  // namespace
}  // namespace capstan::test
