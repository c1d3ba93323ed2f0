#include "tests/support/planted_study/varied_case.h"

#include <algorithm>
#include <stdexcept>

#include "tests/support/planted/log_uniform.h"
#include "tests/support/planted/random_robot.h"

namespace capstan::study {
namespace {

constexpr int kAttempts = 1000;  // robots that are drawn until the effect makes sense on one

test::SensorOptions variedSensors(bool rigid, int joints, base::Random& random) {
  constexpr std::array kRates = {10.0, 15.0, 25.0, 30.0, 60.0};
  constexpr std::array kPeriods = {1, 2, 4};
  test::SensorOptions sensors;
  sensors.frame_rate = kRates[random.bits() % kRates.size()];
  sensors.pixel_sigma *= test::logUniform(random, 0.5, 3.0);
  sensors.distance = random.uniform(0.35, 0.8);
  sensors.focal_length *= random.uniform(0.7, 1.6);
  sensors.turn_count *= test::logUniform(random, 0.5, 4.0);
  sensors.slide_count *= test::logUniform(random, 0.5, 4.0);
  sensors.row_period = kPeriods[random.bits() % (rigid ? 2 : 3)];  // torque of rigid drives is an input
  const double absent = random.uniform(0.0, 1.0);
  if (absent < 0.25) sensors.cameras = false;
  // A tip position determines at most three joints.
  if (absent > 0.88 && !rigid && joints <= 3) sensors.joint_encoders = false;
  return sensors;
}

/// Duration of a recording [s]; short with many joints, whose diagnosis takes long.
double variedDuration(int joints, base::Random& random) {
  constexpr int kMany = 4;
  return random.uniform(8.0, joints < kMany ? 20.0 : 12.0);
}

/// Whether an effect can be planted in a robot and be told there from the robot's other numbers.
bool suits(const StudyCase& one, const test::DrawOptions& options) {
  const int joints = options.robot.size();
  if (one.kind == Kind::kTwo) return joints >= 2;
  if (one.effect.empty()) return true;
  const test::EffectFacts& facts = *test::effectNamed(one.effect);
  // Cameras that follow a point on a line or in a plane show no rotation about it.
  if (facts.place == test::Place::kCamera && joints < 3) return false;
  if (facts.effect == test::Effect::kGravityTilt && joints < 2) return false;
  return !test::jointsFor(facts.effect, options).empty();
}

robot::Description variedRobot(Robot which, base::Random& random) {
  // Time rises with the third power of the number of joints: many joints are rare.
  constexpr std::array kUpTo = {0.1, 0.35, 0.72, 0.92, 0.96, 0.98, 1.0};
  const double drawn = random.uniform(0.0, 1.0);
  const int joints =
      1 + static_cast<int>(std::lower_bound(kUpTo.begin(), kUpTo.end(), drawn) - kUpTo.begin());
  if (which == Robot::kCables) return test::randomCableRobot(joints, random);
  if (which == Robot::kJoints) return test::randomRigidRobot(joints, random);
  return robotOf(which);
}

}  // namespace

test::DrawOptions variedOptions(const StudyCase& one) {
  base::Random random(one.seed, "varied case");
  test::DrawOptions options;
  options.rigid = one.robot != Robot::kRaven && one.robot != Robot::kCables;
  options.ageing = {random.uniform(0.5, 2.0), test::logUniform(random, 0.3, 2.0)};
  options.style = std::array{test::MotionStyle::kMoves, test::MotionStyle::kTransfer,
                             test::MotionStyle::kSweeps, test::MotionStyle::kMultisine}[random.bits() % 4];
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    options.robot = variedRobot(one.robot, random);
    options.sensors = variedSensors(options.rigid, options.robot.size(), random);
    options.duration = variedDuration(options.robot.size(), random);
    if (suits(one, options)) return options;
  }
  throw std::invalid_argument("effect " + one.effect + " makes no sense on robots of the kind " +
                              std::string(base::nameOf(one.robot)));
}

}  // namespace capstan::study
