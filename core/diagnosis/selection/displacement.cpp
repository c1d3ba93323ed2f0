#include "core/diagnosis/selection/displacement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/robot/kinematics.h"

namespace capstan::diagnosis {
namespace {

constexpr double kPeak = 3.0;  // largest displacement, in tolerances of the RMS, that is material by itself

/// Tolerance of what cameras alone show, in that of a joint's length: they see the tip to a millimetre per
/// frame, and some hundred frames average to a tenth of it.
constexpr double kOfCameras = 10.0;

constexpr double kRounding = 1e-12;  // displacement that rounding alone can cause [rad or m]

/// RMS and largest magnitude of numbers that are given one by one.
class Sum {
 public:
  void add(double x) {
    if (!std::isfinite(x)) return;
    squares_ += x * x, ++count_;
    largest_ = std::max(largest_, std::abs(x));
  }
  Displacement displacement(bool slides) const {
    if (largest_ < kRounding) return {0.0, 0.0, slides};
    return {count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0.0, largest_, slides};
  }

 private:
  double squares_ = 0.0, largest_ = 0.0;
  std::size_t count_ = 0;
};

/// Joint encoders and axes of the tip of rigid drives, from the fit's initial states.
void addReadings(const FitData& data, const Fit& fit, const robot::ChainModel& with,
                 const robot::ChainModel& without, std::vector<Sum>& joints, std::array<Sum, 3>& axes) {
  const Eigen::MatrixXd both = data.simulate({with, without}, {fit.initial, fit.initial});
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const ComparedChannel& channel = data.channels()[static_cast<std::size_t>(data.channel()[i])];
    const auto at = static_cast<Eigen::Index>(i);
    Sum& sum = channel.joint > 0 ? joints[static_cast<std::size_t>(channel.joint - 1)]
                                 : axes[static_cast<std::size_t>(channel.axis)];
    sum.add(both(at, 0) - both(at, 1));
  }
}

void addJoints(const SimulatedMotion& with, const SimulatedMotion& without, std::vector<Sum>& joints) {
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (std::size_t k = 0; k < with.q[j].size(); ++k) joints[j].add(with.q[j][k] - without.q[j][k]);
}

void addTip(const robot::Chain& chain, const SimulatedMotion& with, const SimulatedMotion& without,
            Sum& tip) {
  constexpr std::size_t kEvery = 10;  // rows
  for (std::size_t k = 0; k < with.tip.size(); ++k) tip.add((with.tip[k] - without.tip[k]).norm());
  if (!with.tip.empty()) return;
  const auto joints = static_cast<Eigen::Index>(with.q.size());
  robot::JointVector a(joints), b(joints);
  for (std::size_t k = 0; k < with.q.front().size(); k += kEvery) {
    for (Eigen::Index j = 0; j < joints; ++j)
      a[j] = with.q[static_cast<std::size_t>(j)][k], b[j] = without.q[static_cast<std::size_t>(j)][k];
    tip.add((chain.marker(a) - chain.marker(b)).norm());
  }
}

/// Displacement from `without` to `with`. `motions`: those of `with`, one per recording; unused for rigid
/// drives.
Displacements displacementsBetween(const FitData& data, const Fit& fit, const robot::ChainModel& with,
                                   const robot::ChainModel& without,
                                   const std::vector<SimulatedMotion>& motions,
                                   const robot::Description& robot) {
  const robot::Chain chain(robot);
  std::vector<Sum> joints(static_cast<std::size_t>(robot.size()));
  Sum tip;
  std::array<Sum, 3> axes;
  if (data.rigid()) addReadings(data, fit, with, without, joints, axes);
  for (std::size_t r = 0; r < motions.size(); ++r) {
    const SimulatedMotion other = data.simulation(static_cast<int>(r)).motion(without);
    addJoints(motions[r], other, joints);
    addTip(chain, motions[r], other, tip);
  }
  Displacements moves;
  for (std::size_t j = 0; j < joints.size(); ++j)
    moves.joints.push_back(joints[j].displacement(robot.joints[j].type == robot::JointType::kPrismatic));
  moves.tip = tip.displacement(true);
  for (const Sum& axis : axes) {  // of rigid drives; the largest is a bound
    const Displacement along = axis.displacement(true);
    moves.tip.rms = std::hypot(moves.tip.rms, along.rms);
    moves.tip.largest = std::hypot(moves.tip.largest, along.largest);
  }
  return moves;
}

/// Motions of a cable drive in all recordings; empty for rigid drives.
std::vector<SimulatedMotion> motionsOf(const FitData& data, const robot::ChainModel& model) {
  std::vector<SimulatedMotion> motions;
  for (int r = 0; r < data.recordings() && !data.rigid(); ++r)
    motions.push_back(data.simulation(r).motion(model));
  return motions;
}

}  // namespace

Displacements displacementsBy(const FitData& data, const Fit& fit, const EffectCandidate& effect,
                              const robot::Description& robot) {
  const FitModel less = fit.model.without(*effect.hypothesis, effect.joint);
  Eigen::VectorXd none = less.carry(fit.model, fit.u);
  for (const EffectTerm& term : less.effects())  // a background term in its place would take up a part of it
    if (term.hypothesis == effect.hypothesis && term.joint == effect.joint)
      for (const int at : term.index)
        if (at >= 0) none[at] = 0.0;
  const robot::ChainModel with = fit.model.chain(fit.u);
  return displacementsBetween(data, fit, with, less.chain(none), motionsOf(data, with), robot);
}

std::vector<Displacements> displacementsByRefit(const FitData& data, const Fit& fit,
                                                const std::vector<int>& parameters,
                                                const robot::Description& robot) {
  const robot::ChainModel with = fit.model.chain(fit.u);
  const std::vector<SimulatedMotion> motions = motionsOf(data, with);
  std::vector<Displacements> moves;
  for (const int k : parameters) {
    const FitParameter& parameter = fit.model.parameters()[static_cast<std::size_t>(k)];
    Eigen::VectorXd u = fit.u;
    u[k] = parameter.u(parameter.start);
    moves.push_back(displacementsBetween(data, fit, with, fit.model.chain(u), motions, robot));
  }
  return moves;
}

bool isMaterial(const Displacements& moves, const Tolerance& tolerance) {
  const auto toleranceOf = [&](const Displacement& moved) {
    return moved.slides ? tolerance.length : tolerance.angle;
  };
  const auto beyond = [&](const Displacement& moved) {
    return moved.rms > toleranceOf(moved) || moved.largest > kPeak * toleranceOf(moved);
  };
  const bool joints =
      std::ranges::any_of(moves.joints, [](const Displacement& moved) { return moved.largest > 0.0; });
  if (joints) return std::ranges::any_of(moves.joints, beyond);
  return moves.tip.rms > kOfCameras * tolerance.length ||
         moves.tip.largest > kPeak * kOfCameras * tolerance.length;
}

}  // namespace capstan::diagnosis
