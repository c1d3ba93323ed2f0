#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// One number that a fit moves, by way of a dimensionless u whose prior is N(0, prior²).
struct FitParameter {
  std::string name, unit;        ///< "cable_stiffness"; of an effect "backlash.half_width"
  int joint = 0;                 ///< from 1; 0: whole arm
  double start = 0.0;            ///< value at u = 0
  double scale = 1.0;            ///< d value / du, or d ln value / du
  bool logarithmic = false;      ///< value = start exp(scale u), else start + scale u
  double low = 0.0, high = 0.0;  ///< bounds of the value
  double prior = 1.0;

  double value(double u) const;
  double u(double value) const;
  double valueSigma(double u, double sigma) const;  ///< of the value, to first order
};

/// An effect in a model, and where its fit starts.
struct EffectTerm {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;  ///< from 1; 0: whole arm
  EffectStart start;
  bool background = false;  ///< a background effect, limited by Hypothesis::background
  std::vector<int> index;   ///< of its numbers among the model's parameters; −1: stays as in `start`
  int begun = -1;           ///< of JointNumbers::creep_begun, where the hypothesis remembers; −1: none
};

/// A structure to fit: the numbers of the nominal robot that may be mistuned, background effects,
/// and effects.
///
/// Mistuned may be stiffness and damping of cables, joint friction and masses with their inertia, each by a
/// factor, ln N(0, 0.3²), at most kMostMistuned either way; and centres of mass, by 0.15 of their distance
/// from the joint (σ) and 0.3 at most along each axis. What goes beyond has a cause, for a hypothesis to
/// name.
class FitModel {
 public:
  /// `scales`: of each joint.
  FitModel(const robot::Description& nominal, const std::vector<JointScales>& scales);

  int size() const { return static_cast<int>(parameters_.size()); }
  const std::vector<FitParameter>& parameters() const { return parameters_; }
  int baseSize() const { return static_cast<int>(base_.size()); }  ///< mistunable numbers, which come first
  const std::vector<EffectTerm>& effects() const { return effects_; }
  const std::vector<JointScales>& scales() const { return scales_; }
  bool rigid() const { return rigid_; }
  /// True if the effect is in the model as a full effect, not only as a background effect.
  bool has(const Hypothesis& hypothesis, int joint) const;

  /// This model plus one effect; a background term of the same effect and joint is removed.
  FitModel with(const Hypothesis& hypothesis, int joint, const EffectStart& start) const;
  /// Without that effect, its background form back where it has one.
  FitModel without(const Hypothesis& hypothesis, int joint) const;

  const robot::Description& nominal() const { return nominal_; }
  robot::Description refitted(const Eigen::VectorXd& u) const;  ///< the nominal structure alone
  robot::Description extended(const Eigen::VectorXd& u) const;  ///< with all effects, background ones too
  robot::Effect effect(std::size_t k, const Eigen::VectorXd& u) const;
  std::vector<double> effectValues(std::size_t k, const Eigen::VectorXd& u) const;
  robot::ChainModel chain(const Eigen::VectorXd& u) const;

  /// u of this model that has the values of `other` at `u_other` where both have a parameter, else 0.
  Eigen::VectorXd carry(const FitModel& other, const Eigen::VectorXd& u_other) const;
  /// The same; effects that `other` lacks, or has as background effects only, begin at their start values.
  Eigen::VectorXd startFrom(const FitModel& other, const Eigen::VectorXd& u_other) const;
  Eigen::VectorXd clipped(const Eigen::VectorXd& u) const;

 private:
  enum class Number { kStiffness, kDamping, kCoulomb, kViscous, kMass, kCentreX, kCentreY, kCentreZ };

  void addBase();
  void addFactor(Number number, const char* name, const char* unit, int joint, double nominal);
  void addTerm(EffectTerm term);
  int addBegun(const EffectTerm& term);
  EffectTerm backgroundTerm(const Hypothesis& hypothesis, int joint) const;
  FitModel rebuilt(std::vector<EffectTerm> terms) const;

  robot::Description nominal_;
  bool rigid_;
  std::vector<JointScales> scales_;
  std::vector<std::pair<Number, int>> base_;  ///< and its joint, from 0
  std::vector<FitParameter> parameters_;
  std::vector<EffectTerm> effects_;
};
inline constexpr double kMostMistuned = 2.0;

/// Scales that an effect of joint `joint` goes by: the joint's; of the whole arm the last joint's.
const JointScales& scalesOf(const std::vector<JointScales>& scales, int joint);

}  // namespace capstan::diagnosis
