#include "tests/support/planted/planted_case.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/support/planted/log_uniform.h"

namespace capstan::test {
namespace {

constexpr double kCalibrationTime = 5.0;       // [s]
constexpr double kLongCalibrationTime = 10.0;  // until every joint has moved, one after the other [s]

/// The robot of one case and everything that moves it.
class CaseRobot {
 public:
  explicit CaseRobot(const PlantedCase& from)
      : case_(from),
        ageing_(from.seed, "ageing"),
        robot_(from.is_worn ? worn(from.robot, ageing_, from.ageing.wear) : from.robot) {
    base::Random texture(from.seed, "texture");
    texture_ = backgroundTexture(PlantParameters(robot_, from.rigid), texture, from.ageing.texture);
    for (std::size_t k = 0; k < from.effects.size(); ++k) truth_.items.push_back(plant(k));
    truth_.robot = robot_;
    truth_.textured = from.textured;
    if (from.textured) truth_.texture = texture_;
  }

  const Truth& truth() const { return truth_; }

  Recording record() const { return recordAgain({}, case_.duration, case_.seed); }

  Recording recordAgain(const JointPath& path, double duration, std::uint64_t seed) const {
    std::vector<Planted> effects = truth_.texture;
    PlantParameters parameters(robot_, case_.rigid);
    for (const Truth::Item& item : truth_.items) {
      effects.push_back(item.planted);
      plantInParameters(item.planted, case_.robot, parameters);
    }
    parameters.refinement = case_.refinement;
    Plant plant(parameters, effects);
    const PlantedMotion motion = moved(plant, effects, path, duration, seed);
    base::Random noise(seed, "sensors");
    return {sense(motion, case_.robot, effects, case_.sensors, noise), case_.robot};
  }

 private:
  PlantedMotion moved(Plant& plant, const std::vector<Planted>& effects, const JointPath& path,
                      double duration, std::uint64_t seed) const {
    base::Random way(seed, "excitation"), push(seed, "load");
    const Excitation excitation(case_.robot, std::max(duration, seed == case_.seed ? case_.duration : 0.0),
                                way, case_.style);
    const ExternalLoad load(case_.load, push);
    return drive(
        plant, case_.robot, effects, path ? path : [&](double t) { return excitation.at(t); },
        [&](double t) { return load.at(t); }, {duration, 1.0});
  }

  const Visibility& visibility() {
    if (!visibility_) {
      Plant plain(PlantParameters(robot_, case_.rigid), {});
      const double time = case_.style == MotionStyle::kSweeps ? kLongCalibrationTime : kCalibrationTime;
      visibility_.emplace(case_.robot, robot_, case_.rigid, case_.ageing, texture_, case_.sensors,
                          moved(plain, {}, {}, std::min(time, case_.duration), case_.seed));
    }
    return *visibility_;
  }

  Truth::Item plant(std::size_t k) {
    const ChosenEffect& chosen = case_.effects[k];
    base::Random random(case_.seed, k == 0 ? "first effect" : "second effect");
    Truth::Item item;
    item.effect = factsOf(chosen.effect).name;
    item.joint = chosen.joint;
    item.size = chosen.size;
    const int joint = std::max(chosen.joint - 1, 0);
    const PlantParameters parameters(robot_, case_.rigid);
    item.planted = largestPlausible(chosen.effect, joint, parameters, case_.robot, random);
    if (chosen.size == 0.0) {
      item.planted.magnitude = 0.0;
      return item;
    }
    const Sized sized = sizedTo(chosen.size, item.planted, visibility());
    item.planted = sized.planted;
    item.visibility = sized.visibility;
    return item;
  }

  PlantedCase case_;
  base::Random ageing_;
  robot::Description robot_;
  std::vector<Planted> texture_;  ///< the measure of sizes, whether this case has it or not
  std::optional<Visibility> visibility_;
  Truth truth_;
};

/// Coulomb friction moves a joint on its cable by so many RMS of the noise of what sees the joint.
double softness(const DrawOptions& options, int i) {
  const PlantParameters p(options.robot, options.rigid);
  const bool turns = options.robot.joints[static_cast<std::size_t>(i)].type == robot::JointType::kRevolute;
  const SensorOptions& sensors = options.sensors;
  double noise = (turns ? sensors.turn_count : sensors.slide_count) / std::sqrt(12.0);
  if (!sensors.joint_encoders)  // some dozens of pictures in every place, 0.3 m from the axis
    noise = 0.2 * StereoPair(Eigen::Vector3d::Zero(), sensors).sigma() / (turns ? 0.3 : 1.0);
  return frictionStretch(p, i) / p.radius[i] / noise;
}

/// Three times the inertia shows three times the noise in the stretch of the cable.
bool inertiaShows(const DrawOptions& options, int i) {
  const PlantParameters p(options.robot, options.rigid);
  RigidChain chain = p.chain;
  chain.pose(p.middle);
  const double acceleration = 0.4 * options.robot.joints[static_cast<std::size_t>(i)].max_speed;  // times 1/s
  return 3.0 * chain.massMatrix()[i][i] * acceleration / p.coulomb[i] * softness(options, i) > 3.0;
}

bool needsForce(Place place) {
  return place == Place::kCable || place == Place::kFriction || place == Place::kOutside;
}

Effect drawEffect(const DrawOptions& options, bool covered, base::Random& random) {
  std::vector<Effect> possible;
  for (const EffectFacts& facts : allEffects())
    if (facts.covered == covered && !jointsFor(facts.effect, options).empty())
      possible.push_back(facts.effect);
  return possible[random.bits() % possible.size()];
}

/// `wanted`, or any that makes sense; the draw is spent in both cases.
int drawJoint(Effect effect, const DrawOptions& options, std::optional<int> wanted, base::Random& random) {
  std::vector<int> joints = jointsFor(effect, options);
  const std::uint64_t bits = random.bits();
  if (wanted && std::find(joints.begin(), joints.end(), *wanted) == joints.end()) joints.clear();
  if (joints.empty())
    throw std::invalid_argument("effect " + std::string(factsOf(effect).name) +
                                (wanted ? " on joint " + std::to_string(*wanted) : "") +
                                " makes no sense on this robot");
  return wanted ? *wanted : joints[bits % joints.size()];
}

double drawSize(base::Random& random) { return logUniform(random, 0.1, 1.0); }

/// Loads of a case without sensor_sign say nothing about the effect: some have them, most have not.
void drawLoad(PlantedCase& to, base::Random& random) {
  const PlantParameters p(to.robot, to.rigid);
  const double any = random.uniform(0.0, 1.0);
  const double most = to.rigid ? 0.3 : 1.0;  // of Coulomb friction
  for (int i = 0; i < p.size; ++i) {
    const double size = drawSize(random);
    if (any < 0.25) to.load[i] = most * size * p.coulomb[i];
  }
  to.sensors.load_cells = any < 0.25;
  for (const ChosenEffect& chosen : to.effects)
    if (chosen.effect == Effect::kSensorSign) {
      to.sensors.load_cells = true;
      to.load[chosen.joint - 1] = (to.rigid ? 0.15 : 1.2) * chosen.size * p.coulomb[chosen.joint - 1];
    }
}

}  // namespace

std::vector<int> jointsFor(Effect effect, const DrawOptions& options) {
  const EffectFacts& facts = factsOf(effect);
  if (options.rigid ? !facts.rigid : !facts.cable) return {};
  if (facts.place == Place::kCamera && !options.sensors.cameras) return {};
  if (effect == Effect::kEncoderDrift && !options.sensors.joint_encoders) return {};
  if (effect == Effect::kGravityTilt && options.robot.gravity.norm() == 0.0) return {};
  // One joint's M q'' + F = g tau is M/g q'' + F/g = tau: drifted numbers tell it as well.
  if (effect == Effect::kActuatorGain && options.rigid && options.robot.size() == 1) return {};
  if (facts.whole) return {0};
  std::vector<int> joints;
  for (int i = 0; i < options.robot.size(); ++i) {
    if (effect == Effect::kCableCoupling && i == 0) continue;
    const bool of_force = needsForce(facts.place) || facts.place == Place::kBody;
    if (!options.rigid && of_force && softness(options, i) < 5.0) continue;
    if (!options.rigid && effect == Effect::kInertia && !inertiaShows(options, i)) continue;
    joints.push_back(i + 1);
  }
  return joints;
}

PlantedCase draw(std::uint64_t seed, const DrawOptions& options) {
  base::Random random(seed, "case");
  PlantedCase drawn;
  drawn.seed = seed;
  drawn.robot = options.robot;
  drawn.rigid = options.rigid;
  drawn.sensors = options.sensors;
  drawn.ageing = options.ageing;
  drawn.style = options.style;
  if (options.rigid) drawn.sensors.motor_encoders = drawn.sensors.motor_velocity = false;
  const int count = options.effects.value_or(1);
  for (int k = 0; k < count; ++k) {
    ChosenEffect chosen;
    const Effect free = drawEffect(options, !(options.uncovered && k == 0), random);
    chosen.effect = k == 0 ? options.effect.value_or(free) : free;
    while (k == 1 && chosen.effect == drawn.effects.front().effect)
      chosen.effect = drawEffect(options, true, random);
    chosen.joint = drawJoint(chosen.effect, options, k == 0 ? options.joint : std::nullopt, random);
    chosen.size = drawSize(random);
    if (k == 0) chosen.size = options.size.value_or(chosen.size);
    drawn.effects.push_back(chosen);
  }
  drawn.textured = options.textured.value_or(random.bits() % 2 == 0);
  drawn.duration = options.duration.value_or(std::round(random.uniform(20.0, 40.0)));
  drawLoad(drawn, random);
  return drawn;
}

Recording record(const PlantedCase& planted_case) { return CaseRobot(planted_case).record(); }

Recording recordAgain(const PlantedCase& planted_case, const JointPath& path, double duration,
                      std::uint64_t seed) {
  return CaseRobot(planted_case).recordAgain(path, duration, seed);
}

Truth truthOf(const PlantedCase& planted_case) { return CaseRobot(planted_case).truth(); }

std::pair<Recording, Truth> recordWithTruth(const PlantedCase& planted_case) {
  const CaseRobot robot(planted_case);
  return {robot.record(), robot.truth()};
}

}  // namespace capstan::test
