#include "tests/support/planted_study/ideal_limit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tests/support/planted/background_changes.h"
#include "tests/support/planted/excitation.h"

namespace capstan::study {
namespace {

using test::Planted;

constexpr std::size_t kStride = 5;  // rows from one that is looked at to the next

}  // namespace

/// Everything that the sensors of a case would tell, each over its standard deviation.
class IdealObserver::Sensors {
 public:
  Sensors(const test::PlantedCase& of, const robot::Description& worn, double seconds)
      : case_(of), worn_(worn), chain_(of.robot) {
    base::Random way(of.seed, "excitation"), push(of.seed, "load");
    const test::Excitation excitation(of.robot, of.duration, way, of.style);
    const test::ExternalLoad load(of.load, push);
    test::Plant plant(test::PlantParameters(worn_, of.rigid), {});
    motion_ = drive(
        plant, of.robot, {}, [&](double t) { return excitation.at(t); }, [&](double t) { return load.at(t); },
        {std::min(seconds, of.duration), 1.0});
    base::Random frames(of.seed, "frames");
    if (of.sensors.cameras) frames_ = exposures(motion_, of.sensors, frames);
  }

  double duration() const { return motion_.t.back(); }

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
  robot::Description worn_;
  test::RigidChain chain_;
  test::PlantedMotion motion_;
  std::vector<std::size_t> frames_;
};

IdealObserver::IdealObserver(const test::PlantedCase& planted_case, const test::Truth& truth, double seconds)
    : sensors_(std::make_unique<Sensors>(planted_case, truth.robot, seconds)),
      worn_(truth.robot),
      times_(planted_case.duration / sensors_->duration()),
      plain_(sensors_->tell(worn_, {})) {
  std::vector<test::BackgroundChange> changes =
      test::backgroundChanges(planted_case.robot, worn_, planted_case.rigid, planted_case.ageing);
  if (!truth.textured)
    std::erase_if(changes, [](const test::BackgroundChange& change) { return !change.texture.empty(); });
  spread_.resize(plain_.size(), static_cast<Eigen::Index>(changes.size()));
  for (Eigen::Index column = 0; const test::BackgroundChange& change : changes)
    spread_.col(column++) = (sensors_->tell(change.robot, change.texture) - plain_) / test::kBackgroundStep;
  normal_.compute(Eigen::MatrixXd::Identity(spread_.cols(), spread_.cols()) +
                  times_ * spread_.transpose() * spread_);
}

IdealObserver::~IdealObserver() = default;

Eigen::VectorXd IdealObserver::change(const Planted& planted) {
  return sensors_->tell(worn_, {planted}) - plain_;
}

/// (I + J Jᵀ)⁻¹ = I − J (I + Jᵀ J)⁻¹ Jᵀ, in standard deviations.
double IdealObserver::deflection(const Eigen::VectorXd& change) const {
  const Eigen::VectorXd along = times_ * spread_.transpose() * change;
  return std::sqrt(std::max(times_ * change.squaredNorm() - along.dot(normal_.solve(along)), 0.0));
}

double IdealObserver::deflection(const Planted& planted) { return deflection(change(planted)); }

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
