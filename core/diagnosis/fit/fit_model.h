#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// One parameter of a fit. The fit changes a dimensionless u with the prior N(0, prior²).
struct FitParameter {
  std::string name, unit;        ///< "cable_stiffness"; of an effect "backlash.half_width"
  int joint = 0;                 ///< joint, from 1; 0: whole arm
  double start = 0.0;            ///< value at u = 0
  double scale = 1.0;            ///< d value / du, or d ln value / du
  bool logarithmic = false;      ///< value = start exp(scale u), else start + scale u
  double low = 0.0, high = 0.0;  ///< bounds of the value
  double prior = 1.0;            ///< standard deviation of u

  double value(double u) const;                     ///< value at u, within the bounds
  double u(double value) const;                     ///< inverse of value()
  double valueSigma(double u, double sigma) const;  ///< sigma of the value from that of u, to first order
};

/// One effect of a model, and the start of its fit.
struct EffectTerm {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;  ///< joint, from 1; 0: whole arm
  EffectStart start;
  bool background = false;  ///< true for a background effect: its size is limited by Hypothesis::background
  std::vector<int> index;   ///< indices of its numbers in FitModel::parameters(); −1: fixed as in `start`
  int begun = -1;           ///< index of Hypothesis::begun; −1: none
};

/// Model that is fitted: the nominal robot with adjustable parameters, effects that explain the recordings,
/// and background effects. A background effect is one that every robot has to a small degree, such as a
/// slightly eccentric capstan: it is fitted up to its normal size and is not reported as a cause.
///
/// Adjustable are cable stiffness and damping, joint friction, and masses with their inertia. Each has a
/// factor whose logarithm has a normal prior. Constants of cables and friction are often wrong by a factor of
/// two (σ = 0.7, at most 8), masses by a third (σ = 0.3, at most 2). Centres of mass are adjustable along
/// each axis, with σ 0.15 and at most 0.3 of their distance from the joint. A larger deviation needs a
/// hypothesis that explains it.
class FitModel {
 public:
  /// `scales` has one entry per joint.
  FitModel(const robot::Description& nominal, const std::vector<JointScales>& scales);

  int size() const { return static_cast<int>(parameters_.size()); }
  const std::vector<FitParameter>& parameters() const { return parameters_; }
  int baseSize() const { return static_cast<int>(base_.size()); }  ///< nominal parameters, which come first
  const std::vector<EffectTerm>& effects() const { return effects_; }
  const std::vector<JointScales>& scales() const { return scales_; }
  bool rigid() const { return rigid_; }
  /// True if the effect is in the model as a full effect, not only as a background effect.
  bool has(const Hypothesis& hypothesis, int joint) const;

  /// This model with one more effect, which replaces the background effect of the same name and joint.
  FitModel with(const Hypothesis& hypothesis, int joint, const EffectStart& start) const;
  /// This model without that effect; its background effect is restored if it has one.
  FitModel without(const Hypothesis& hypothesis, int joint) const;

  const robot::Description& nominal() const { return nominal_; }
  robot::Description refitted(const Eigen::VectorXd& u) const;  ///< the nominal structure alone
  robot::Description extended(const Eigen::VectorXd& u) const;  ///< with all effects, also background effects
  robot::Effect effect(std::size_t k, const Eigen::VectorXd& u) const;  ///< effect k with its values at u
  std::vector<double> effectValues(std::size_t k, const Eigen::VectorXd& u) const;
  robot::ChainModel chain(const Eigen::VectorXd& u) const;

  /// u of this model with the values that `other` has at `u_other`; 0 for parameters that `other` lacks.
  Eigen::VectorXd carry(const FitModel& other, const Eigen::VectorXd& u_other) const;
  /// carry(), but effects that `other` lacks or has only as background effects are at their start values.
  Eigen::VectorXd startFrom(const FitModel& other, const Eigen::VectorXd& u_other) const;
  /// Log prior density of the values at u over that of the nominal robot in good order [nats]:
  /// −½ Σ (u / prior)² of nominal parameters and background effects, −½ Σ (v / (kEffectPrior scale))² of the
  /// numbers v of effects that are zero in a robot without the effect. The time of an event is uniform over
  /// the recording; SetPrior counts its instants.
  double logPrior(const Eigen::VectorXd& u) const;
  /// u with every value within its bounds.
  Eigen::VectorXd clipped(const Eigen::VectorXd& u) const;

 private:
  /// How far a nominal number may be wrong: σ of the logarithm of its factor, and the largest factor.
  struct Spread {
    double sigma, most;
  };
  static constexpr Spread kConstants{0.7, 8.0};  ///< of cables and friction
  static constexpr Spread kMasses{0.3, 2.0};
  enum class Number { kStiffness, kDamping, kCoulomb, kViscous, kMass, kCentreX, kCentreY, kCentreZ };

  void addBase();
  void addFactor(Number number, const char* name, const char* unit, int joint, double nominal,
                 const Spread& spread);
  void addTerm(EffectTerm term);
  int addBegun(const EffectTerm& term);
  std::pair<double, double> shapesOf(const EffectTerm& term, std::size_t k) const;
  EffectTerm backgroundTerm(const Hypothesis& hypothesis, int joint) const;
  FitModel rebuilt(std::vector<EffectTerm> terms) const;

  robot::Description nominal_;
  bool rigid_;
  std::vector<JointScales> scales_;
  std::vector<std::pair<Number, int>> base_;  ///< number and joint, from 0
  std::vector<FitParameter> parameters_;
  std::vector<EffectTerm> effects_;
};

/// Scales of an effect: those of joint `joint` (from 1); those of the last joint for the whole arm (0).
const JointScales& scalesOf(const std::vector<JointScales>& scales, int joint);

}  // namespace capstan::diagnosis
