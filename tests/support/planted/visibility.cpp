#include <algorithm>
#include <cmath>

#include "tests/support/planted/background_changes.h"
#include "tests/support/planted/effect_sizes.h"

namespace capstan::test {
namespace {

constexpr std::size_t kStride = 20;     // rows from one that is looked at to the next
constexpr std::size_t kFreeRows = 500;  // after which the replay of a rigid drive restarts: 0.5 s
constexpr int kSweeps = 400;

double rms(const Eigen::Ref<const Eigen::MatrixXd>& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(x.rows(), 1)));
}

/// Least ½ xᵀ G x − bᵀ x with low ≤ x ≤ high, by coordinates in turn (Hildreth 1957); 0 is within.
Eigen::VectorXd leastWithin(const Eigen::MatrixXd& g, const Eigen::VectorXd& b, const Eigen::VectorXd& low,
                            const Eigen::VectorXd& high) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (Eigen::Index k = 0; k < x.size(); ++k)
      if (g(k, k) > 0.0) x[k] = std::clamp(x[k] + (b[k] - g.col(k).dot(x)) / g(k, k), low[k], high[k]);
  return x;
}

/// The motion with the torques of a table: those of its rows, held until the next row.
PlantedMotion withTorquesOfRows(PlantedMotion motion, int row_period) {
  for (std::size_t k = 0; k < motion.torque.size(); ++k)
    motion.torque[k] = motion.torque[k - k % static_cast<std::size_t>(row_period)];
  return motion;
}

}  // namespace

Visibility::Visibility(const robot::Description& nominal, const robot::Description& worn, bool rigid,
                       const Ageing& ageing, const std::vector<Planted>& texture,
                       const SensorOptions& sensors, PlantedMotion motion)
    : nominal_(nominal),
      worn_(worn),
      parameters_(worn, rigid),
      sensors_(sensors),
      recorded_(std::move(motion)) {
  plain_motion_ = replayOf(worn_, {});
  plain_ = tell(plain_motion_, {});
  const int joints = parameters_.size;
  noise_ = Eigen::VectorXd::Constant(joints + 1, StereoPair(Eigen::Vector3d::Zero(), sensors_).sigma());
  for (int i = 0; i < joints; ++i) {
    const bool turns = nominal_.joints[static_cast<std::size_t>(i)].type == robot::JointType::kRevolute;
    noise_[i] = (turns ? sensors_.turn_count : sensors_.slide_count) / std::sqrt(12.0);
  }
  const Eigen::VectorXd of_texture = channels(changeBy(texture)), of_rows = channels(changeByRows());
  unexplained_ = (noise_.array().square() + of_rows.array().square()).sqrt();
  level_ = (unexplained_.array().square() + of_texture.array().square()).sqrt();
  findBackgroundChanges(ageing);
}

/// In noise of a reading; sensors that are not there tell nothing.
Eigen::VectorXd Visibility::weighted(const Eigen::MatrixXd& change) const {
  Eigen::MatrixXd seen = change;
  const Eigen::Index joints = parameters_.size;
  for (Eigen::Index i = 0; i < joints; ++i) seen.col(i) *= sensors_.joint_encoders ? 1.0 / noise_[i] : 0.0;
  seen.rightCols(3) *= sensors_.cameras ? std::sqrt(3.0) / noise_[joints] : 0.0;
  return seen.reshaped();
}

void Visibility::findBackgroundChanges(const Ageing& ageing) {
  const std::vector<BackgroundChange> changes = backgroundChanges(nominal_, worn_, parameters_.rigid, ageing);
  const auto count = static_cast<Eigen::Index>(changes.size());
  background_.resize(plain_.size(), count);
  low_.resize(count), high_.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const BackgroundChange& one = changes[static_cast<std::size_t>(k)];
    const Eigen::MatrixXd told = tell(replayOf(one.robot, one.texture), one.texture);
    background_.col(k) = weighted((told - plain_) / kBackgroundStep);
    low_[k] = one.low, high_[k] = one.high;
  }
  normal_ = background_.transpose() * background_;
}

PlantedMotion Visibility::replayOf(const robot::Description& robot,
                                   const std::vector<Planted>& effects) const {
  PlantParameters changed(robot, parameters_.rigid);
  for (const Planted& e : effects) plantInParameters(e, nominal_, changed);
  Plant plant(changed, effects);
  return replay(plant, recorded_, effects, kFreeRows);
}

Eigen::MatrixXd Visibility::tell(const PlantedMotion& motion, const std::vector<Planted>& effects) const {
  RigidChain chain(nominal_);
  const auto rows = static_cast<Eigen::Index>((motion.t.size() + kStride - 1) / kStride);
  Eigen::MatrixXd told(rows, parameters_.size + 3);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const std::size_t k = static_cast<std::size_t>(r) * kStride;
    for (int i = 0; i < parameters_.size; ++i) told(r, i) = jointReading(motion, k, i, effects);
    told.row(r).tail(3) = cameraTip(motion, k, chain, nominal_.marker, effects);
  }
  return told;
}

Eigen::MatrixXd Visibility::changeBy(const std::vector<Planted>& effects) const {
  const bool outside_the_arm = std::all_of(effects.begin(), effects.end(), [](const Planted& e) {
    return factsOf(e.effect).place == Place::kCamera || e.effect == Effect::kEncoderDrift;
  });
  return tell(outside_the_arm ? plain_motion_ : replayOf(worn_, effects), effects) - plain_;
}

Eigen::MatrixXd Visibility::changeByRows() const {
  if (!parameters_.rigid) return Eigen::MatrixXd::Zero(plain_.rows(), plain_.cols());
  Plant plant(PlantParameters(worn_, true), {});
  return tell(replay(plant, withTorquesOfRows(recorded_, sensors_.row_period), {}, kFreeRows), {}) - plain_;
}

Eigen::VectorXd Visibility::channels(const Eigen::MatrixXd& change) const {
  const Eigen::Index joints = parameters_.size;
  Eigen::VectorXd found(joints + 1);
  for (Eigen::Index i = 0; i < joints; ++i) found[i] = rms(change.col(i));
  found[joints] = rms(change.rightCols(3));
  return found;
}

double Visibility::of(const Planted& planted) const {
  const Eigen::VectorXd moved = weighted(changeBy({planted}));
  const Eigen::VectorXd mimic = leastWithin(normal_, background_.transpose() * moved, low_, high_);
  const Eigen::VectorXd left = moved - background_ * mimic;
  const Place place = factsOf(planted.effect).place;
  const bool drifts = place != Place::kCamera && planted.effect != Effect::kEncoderDrift &&
                      planted.effect != Effect::kCableCompliance;
  const Eigen::VectorXd& level = parameters_.rigid && !drifts ? unexplained_ : level_;
  Eigen::VectorXd shown = channels(left.reshaped(plain_.rows(), plain_.cols()));
  shown[parameters_.size] /= std::sqrt(3.0);
  return shown.cwiseProduct(noise_).cwiseQuotient(level).maxCoeff();
}

}  // namespace capstan::test
