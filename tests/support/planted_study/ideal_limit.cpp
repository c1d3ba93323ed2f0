#include "tests/support/planted_study/ideal_limit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/planted/excitation.h"

namespace capstan::study {
namespace {

using test::Planted;

constexpr double kStep = 0.02;      // of the derivatives, in standard deviations
constexpr std::size_t kStride = 5;  // rows from one that is looked at to the next
// Standard deviations as drawn by test::aged and test::everydayTexture.
const double kFactor = std::log(2.0) / std::sqrt(12.0);  // of ln of a number between 0.7 and 1.4
const double kShift = 0.3 / std::sqrt(12.0);             // of the centre of mass, share of its arm
const double kTrace = std::sqrt(7e-4);                   // of a share between 0.01 and 0.04 of any sign
const double kEccentric = 0.64e-3;                       // of the capstan's radius
const double kStribeck = 0.012;                          // of an excess between 0.01 and 0.05

/// Robots of which one aged number each is off by kStep standard deviations.
std::vector<robot::Description> neighbours(const robot::Description& aged, bool rigid) {
  std::vector<robot::Description> all;
  const auto scaled = [&](std::size_t i, auto&& change) {
    robot::Description& robot = all.emplace_back(aged);
    change(robot.joints[i], robot.drives[i]);
  };
  const double factor = std::exp(kStep * kFactor);
  for (std::size_t i = 0; i < aged.joints.size(); ++i) {
    scaled(i, [&](robot::Joint& joint, robot::Drive&) { joint.friction.coulomb *= factor; });
    scaled(i, [&](robot::Joint& joint, robot::Drive&) { joint.friction.viscous *= factor; });
    scaled(i, [&](robot::Joint& joint, robot::Drive&) {
      joint.link.mass *= factor;
      joint.link.inertia *= factor;
    });
    for (int axis = 0; axis < 3; ++axis)
      scaled(i, [&](robot::Joint& joint, robot::Drive&) {
        joint.link.centre_of_mass(axis) += kStep * kShift * joint.link.centre_of_mass.norm();
      });
    if (rigid) {
      scaled(i, [&](robot::Joint&, robot::Drive& drive) { drive.motor_friction.coulomb *= factor; });
      scaled(i, [&](robot::Joint&, robot::Drive& drive) { drive.motor_friction.viscous *= factor; });
    } else {
      scaled(i, [&](robot::Joint&, robot::Drive& drive) { drive.cable_stiffness *= factor; });
      scaled(i, [&](robot::Joint&, robot::Drive& drive) { drive.cable_damping *= factor; });
    }
  }
  return all;
}

/// kStep standard deviations of each part of the texture.
std::vector<Planted> textures(const test::PlantParameters& p) {
  std::vector<Planted> all;
  for (int i = 0; i < p.size; ++i) {
    Planted one;
    one.joint = i;
    one.effect = test::Effect::kAsymmetricFriction;
    one.magnitude = kStep * kTrace;
    all.push_back(one);
    one.effect = test::Effect::kStribeckFriction;
    one.magnitude = kStep * kStribeck;
    one.signature = 6.0 * p.smoothing[i];
    all.push_back(one);
    if (p.rigid) continue;
    one.effect = test::Effect::kCapstanEccentricity;
    one.magnitude = kStep * kEccentric * p.capstan[i] / std::numbers::sqrt2;
    all.push_back(one);
    one.phase = 0.5 * std::numbers::pi;
    all.push_back(one);
  }
  return all;
}

}  // namespace

/// Everything that the sensors of a case would tell, each over its standard deviation.
class IdealObserver::Sensors {
 public:
  Sensors(const test::PlantedCase& of, const robot::Description& aged, double seconds)
      : case_(of), aged_(aged), chain_(of.robot) {
    base::Random way(of.seed, "excitation"), push(of.seed, "load");
    const test::Excitation excitation(of.robot, of.duration, way);
    const test::ExternalLoad load(of.load, push);
    test::Plant plant(test::PlantParameters(aged_, of.rigid), {});
    motion_ = drive(
        plant, of.robot, {}, [&](double t) { return excitation.at(t); }, [&](double t) { return load.at(t); },
        {std::min(seconds, of.duration), 1.0});
    base::Random frames(of.seed, "frames");
    if (of.sensors.cameras) frames_ = exposures(motion_, of.sensors, frames);
  }

  double duration() const { return motion_.t.back(); }

  /// Largest RMS of a channel, in noise of one reading.
  double mostOf(const Eigen::VectorXd& told) const {
    const Eigen::Index rows = case_.sensors.joint_encoders
                                  ? static_cast<Eigen::Index>((motion_.t.size() + kStride - 1) / kStride)
                                  : 0;
    const auto rms = [](const auto& part, double weight) {
      return std::sqrt(part.squaredNorm() / std::max<double>(1.0, static_cast<double>(part.size())) / weight);
    };
    double most = 0.0;
    for (Eigen::Index j = 0; rows > 0 && j < case_.robot.size(); ++j)
      most = std::max(most, rms(told.segment(j * rows, rows), static_cast<double>(kStride)));
    const Eigen::Index tips = told.size() - rows * case_.robot.size();
    return tips > 0 ? std::max(most, rms(told.tail(tips), 1.0)) : most;
  }

  Eigen::VectorXd tell(const robot::Description& robot, const std::vector<Planted>& effects) {
    test::PlantParameters parameters(robot, case_.rigid);
    for (const Planted& one : effects) plantInParameters(one, case_.robot, parameters);
    test::Plant plant(parameters, effects);
    const test::PlantedMotion motion = replay(plant, motion_, effects);
    std::vector<double> told;
    if (case_.sensors.joint_encoders) tellJoints(motion, effects, told);
    const double sigma = test::StereoPair(Eigen::Vector3d::Zero(), case_.sensors).sigma() / std::sqrt(3.0);
    for (const std::size_t k : frames_) {
      const Eigen::Vector3d tip = cameraTip(motion, k, chain_, case_.robot.marker, effects) / sigma;
      told.insert(told.end(), tip.begin(), tip.end());
    }
    return Eigen::Map<const Eigen::VectorXd>(told.data(), static_cast<Eigen::Index>(told.size()));
  }

 private:
  /// Rows between those that are looked at tell the same once more.
  void tellJoints(const test::PlantedMotion& motion, const std::vector<Planted>& effects,
                  std::vector<double>& told) const {
    for (int i = 0; i < case_.robot.size(); ++i) {
      const bool turns = case_.robot.joints[static_cast<std::size_t>(i)].type == robot::JointType::kRevolute;
      const double count = turns ? case_.sensors.turn_count : case_.sensors.slide_count;
      const double sigma = count / std::sqrt(12.0 * static_cast<double>(kStride));
      for (std::size_t k = 0; k < motion.t.size(); k += kStride)
        told.push_back(jointReading(motion, k, i, effects) / sigma);
    }
  }

  test::PlantedCase case_;
  robot::Description aged_;
  test::RigidChain chain_;
  test::PlantedMotion motion_;
  std::vector<std::size_t> frames_;
};

IdealObserver::IdealObserver(const test::PlantedCase& planted_case, const test::Truth& truth, double seconds)
    : sensors_(std::make_unique<Sensors>(planted_case, truth.robot, seconds)),
      aged_(truth.robot),
      times_(planted_case.duration / sensors_->duration()),
      plain_(sensors_->tell(aged_, {})) {
  const auto off = neighbours(aged_, planted_case.rigid);
  std::vector<Planted> texture;
  if (truth.textured) texture = textures(test::PlantParameters(aged_, planted_case.rigid));
  spread_.resize(plain_.size(), static_cast<Eigen::Index>(off.size() + texture.size()));
  Eigen::Index column = 0;
  for (const auto& robot : off) spread_.col(column++) = (sensors_->tell(robot, {}) - plain_) / kStep;
  for (const Planted& one : texture) spread_.col(column++) = (sensors_->tell(aged_, {one}) - plain_) / kStep;
  normal_.compute(Eigen::MatrixXd::Identity(spread_.cols(), spread_.cols()) +
                  times_ * spread_.transpose() * spread_);
}

IdealObserver::~IdealObserver() = default;

Eigen::VectorXd IdealObserver::change(const Planted& planted) {
  return sensors_->tell(aged_, {planted}) - plain_;
}

/// (I + J Jᵀ)⁻¹ = I − J (I + Jᵀ J)⁻¹ Jᵀ, in standard deviations.
double IdealObserver::deflection(const Eigen::VectorXd& change) const {
  const Eigen::VectorXd along = times_ * spread_.transpose() * change;
  return std::sqrt(std::max(times_ * change.squaredNorm() - along.dot(normal_.solve(along)), 0.0));
}

double IdealObserver::deflection(const Planted& planted) { return deflection(change(planted)); }

double IdealObserver::beyondAgeing(const Planted& planted) {
  const Eigen::VectorXd moved = change(planted);
  const Eigen::VectorXd left = moved - spread_ * normal_.solve(times_ * spread_.transpose() * moved);
  return sensors_->mostOf(left);
}

IdealObserver::Limit IdealObserver::limit(const Planted& planted, double size) {
  const Eigen::VectorXd whole = change(planted);
  const double most = deflection(whole);
  if (most == 0.0) return {std::nan(""), std::nan("")};
  if (most <= kHalfFound || planted.effect == test::Effect::kSensorSign)
    return {kHalfFound / most, size * kHalfFound / most};
  // Secant on logarithms between a share that shows too little, once one is known, and one that shows too
  // much.
  double low = 0.0, high = 1.0, at_low = 0.0, at_high = most;
  Limit limit{1.0, size};
  for (int round = 0; round < 20; ++round) {
    double share = high * std::min(kHalfFound / at_high, 0.5);
    if (low > 0.0) {
      const double width = std::log(high / low);
      const double slope = std::max(std::log(at_high / at_low), 1e-3) / width;
      share = low * std::exp(std::clamp(std::log(kHalfFound / at_low) / slope, 0.1 * width, 0.9 * width));
    }
    Planted less = planted;
    less.magnitude *= share;
    const Eigen::VectorXd moved = change(less);
    const double now = deflection(moved);
    limit = {share, size * moved.norm() / whole.norm()};
    if (std::abs(now / kHalfFound - 1.0) < 0.05) break;
    (now < kHalfFound ? low : high) = share;
    (now < kHalfFound ? at_low : at_high) = std::max(now, 1e-9);
  }
  return limit;
}

}  // namespace capstan::study
