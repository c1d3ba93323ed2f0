#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>

#include "core/base/check.h"
#include "core/estimation/models.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_kernel.h"
#include "core/tracking/extended_arm_model.h"
#include "core/tracking/motor_correction.h"

namespace capstan::tracking {

/// A set of motors or joints: bit j for joint j + 1.
using JointSet = unsigned;
inline bool contains(JointSet set, int joint) { return ((set >> joint) & 1U) != 0U; }

/// A motor sample as input of the filter: q_m from the hard stop [rad], dq_m [rad/s].
struct MotorState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  JointSet unknown = 0;  ///< motors without an encoder reading; their position and velocity are ignored
  double blind = 0.0;    ///< time since the camera last saw the tip [s]; used for unknown motors only
  CableMemory memory{};  ///< state of hysteresis and creep of the cables at that time; used for robots with
                         ///< effects only
  MotorCorrection correction{};  ///< estimated correction of position and velocity
};

/// Input of the model over one step.
struct CableArmInput : CableArmDrive {
  CableArmInput() : CableArmDrive{} {}
  CableArmInput(const CableArmDrive& drive) : CableArmDrive(drive) {}  // all motors known
  JointSet unknown = 0;
  double blind = 0.0;
  CableMemory memory;  ///< cable memory at the start of the step
};

/// Motion model of a joint whose motor is unknown: a random acceleration. The joint's speed has the standard
/// deviation `speed` [rad/s, rad/s, m/s], and its correlation over a time difference s is
///     rho(s) = (1 + s / time) exp(−s / time),
/// the second-order Gauss–Markov process (Gelb, Applied Optimal Estimation, 1974, table 2.2-1), which is as
/// smooth as hand motion. The best prediction of a speed last observed `blind` seconds ago shrinks as rho and
/// has the variance speed² (1 − rho²). With one state for the speed, this is
///     d(dq) = −decay dq dt + speed √(2 decay) dW,   decay = −rho' / rho = blind / (time (time + blind)).
struct UnknownMotion {
  Eigen::Vector3d speed = Eigen::Vector3d::Ones();
  double time = 1.0;  ///< [s]

  double decay(double blind) const { return blind / (time * (time + blind)); }  ///< [1/s]
  /// Density of the process noise on dq [rad/s/√s, rad/s/√s, m/s/√s].
  Eigen::Vector3d density(double blind) const { return std::sqrt(2.0 * decay(blind)) * speed; }
};

/// Constants of `robot` for the kernels. Throws base::InputError when the arm is not a three-joint
/// remote-centre arm.
CableArmConstants cableArmConstants(const robot::Description& robot);

/// Upper bound [1/s] on the magnitude of the link side's eigenvalues within the joint limits: those of M⁻¹ D
/// (cable damping and the steepest friction) and of sqrt(M⁻¹ K) (cable stiffness).
double cableArmRate(const robot::Description& robot);

/// The filter's process model, UKF paper (5)–(10): x = [q1 dq1 q2 dq2 q3 dq3]. Its inputs are the measured
/// motor position and velocity, interpolated linearly between samples. It is integrated by classical RK4 in
/// steps = ceil(dt · rate / 2) sub-steps, because RK4 is stable up to |λ| dt = 2.78. All 13 sigma points
/// advance in parallel (cable_arm_kernel.h).
///
/// Sigma points are clamped to the bounds of plausible states (joint limits widened by their own range, ten
/// times the largest speeds). A filter that starts with metres of uncertainty therefore stays finite and
/// recovers; in normal operation no point reaches the bounds.
///
/// A joint whose motor is unknown follows UnknownMotion, and the force of its cable is solved from that
/// (CableArmUnknown). The cables of the other motors still act. If motor 1 or 2 is unknown, they also
/// constrain its joint through the coupling: cable 2 constrains C01 q1 + q2, cable 3 constrains C02 q1 + C12
/// q2 + q3.
///
/// The model includes the effects of a robot file: effects that constants can express (robot::foldEffects())
/// change the constants, others act through the laws of robot/chain (ExtendedArmModel). The cables' memory is
/// part of the control, and remember() computes its next value. While a motor is unknown, only the constants
/// act. encoder_slip, zero_drift and the cameras' effects are no part of this model. A StateModel and
/// SampledStateModel; copyable; thread-safe when const.
class CableArmModel {
 public:
  static constexpr int kStates = 6;
  using Control = MotorState;
  using Input = CableArmInput;
  using State = Eigen::Matrix<double, 6, 1>;
  using Points = estimation::SigmaPoints<kStates>;
  using Density = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

  /// Throws base::InputError for a robot that is not a cable-driven three-joint remote-centre arm.
  explicit CableArmModel(const robot::Description& robot,
                         math::InstructionSet set = math::bestInstructionSet());

  static Input interval(const Control& start, const Control& end);
  static Control between(const Control& start, const Control& end, double fraction);

  void propagate(Points& points, const Input& input, double dt) const {
    if (input.unknown != 0) return propagateUnknown(points, input, dt);
    if (extended_) return extended_->propagate(points, input, input.memory, dt);
    kernel_->propagate(constants_, input, dt, stepsFor(dt), points.data());
  }
  /// Propagates one state instead of sigma points.
  State propagateOne(const State& x, const Input& input, double dt) const;

  /// Cable memory after a step of the state x, for a robot with effects; otherwise the memory of `input`.
  CableMemory remember(const State& x, const Input& input, double dt) const;
  /// Model of the effects that constants cannot express; null if the robot has none.
  const ExtendedArmModel* extended() const { return extended_.get(); }

  /// Number of sub-steps for dt, at least 1.
  int stepsFor(double dt) const;
  /// Fixes the number of sub-steps (comparisons and benchmarks); 0: computed from rate().
  void setSteps(int steps) { fixed_steps_ = steps; }

  const CableArmConstants& constants() const { return constants_; }
  /// Replaces the constants at run time (identification). `rate` must bound the eigenvalues for the new
  /// values, as cableArmRate() does. Only for a model without extended().
  void setConstants(const CableArmConstants& constants, double rate) {
    CAPSTAN_ASSERT(!extended_);
    constants_ = constants;
    rate_ = rate;
  }
  double rate() const { return rate_; }

  void setUnknownMotion(const UnknownMotion& motion) { unknown_motion_ = motion; }
  /// Square root of the process noise per second: `density`, which holds for known motors, with the rows of
  /// unknown joints replaced by their random acceleration.
  Density density(const Input& input, const Density& density) const;

 private:
  void propagateUnknown(Points& points, const Input& input, double dt) const;

  CableArmConstants constants_;
  const CableArmKernel* kernel_;
  std::shared_ptr<const ExtendedArmModel> extended_;
  double rate_;
  int fixed_steps_ = 0;
  UnknownMotion unknown_motion_;
};

/// Carries the cable memory from motor sample to motor sample, along the filter's mean.
class RememberedCables {
 public:
  RememberedCables() = default;
  explicit RememberedCables(const MotorState& first) : driven_(first) {}

  /// Cable memory at the sample `now`; the previous sample was `dt` [s] earlier, when the mean was x.
  CableMemory advance(const CableArmModel& model, const CableArmModel::State& x, const MotorState& now,
                      double dt) {
    const CableMemory memory = model.remember(x, CableArmModel::interval(driven_, now), dt);
    driven_ = now;
    driven_.memory = memory;
    return memory;
  }
  /// Replaces the motor correction of the last sample.
  void correct(const MotorCorrection& correction) { driven_.correction = correction; }

 private:
  MotorState driven_;
};

}  // namespace capstan::tracking
