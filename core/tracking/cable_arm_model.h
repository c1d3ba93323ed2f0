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

/// A motor sample as the filter takes it: q_m from the hard stop [rad], dq_m [rad/s].
struct MotorState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  JointSet unknown = 0;  ///< motors whose encoder says nothing; their numbers are not looked at
  double blind = 0.0;    ///< time since the camera last saw the tip [s]; matters for unknown motors only
  CableMemory memory{};  ///< of the cables at that time; matters for robots with effects only
  MotorCorrection correction{};  ///< what the transmission makes of position and velocity
};

/// What drives the model over a step.
struct CableArmInput : CableArmDrive {
  CableArmInput() : CableArmDrive{} {}
  CableArmInput(const CableArmDrive& drive) : CableArmDrive(drive) {}  // all motors known
  JointSet unknown = 0;
  double blind = 0.0;
  CableMemory memory;  ///< at the start
};

/// How a joint moves whose motor is unknown: by a random acceleration that lets its speed, of standard
/// deviation `speed` [rad/s, rad/s, m/s], correlate over a lag s as
///     rho(s) = (1 + s / time) exp(−s / time),
/// the second-order Gauss–Markov process (Gelb, Applied Optimal Estimation, 1974, table 2.2-1), smooth as
/// hands are. Of a speed last seen `blind` seconds ago its best prediction shrinks as rho and has the
/// variance speed² (1 − rho²): with one state for the speed,
///     d(dq) = −decay dq dt + speed √(2 decay) dW,   decay = −rho' / rho = blind / (time (time + blind)).
struct UnknownMotion {
  Eigen::Vector3d speed = Eigen::Vector3d::Ones();
  double time = 1.0;  ///< [s]

  double decay(double blind) const { return blind / (time * (time + blind)); }  ///< [1/s]
  /// Density of the process noise on dq [rad/s/√s, rad/s/√s, m/s/√s].
  Eigen::Vector3d density(double blind) const { return std::sqrt(2.0 * decay(blind)) * speed; }
};

/// The numbers of `robot` that the kernels need. Throws base::InputError when the arm is not a three-joint
/// remote-centre arm.
CableArmConstants cableArmConstants(const robot::Description& robot);

/// Upper bound [1/s] on the magnitude of the link side's eigenvalues anywhere in the joint limits: of M⁻¹ D,
/// cable damping and the steepest friction, and of sqrt(M⁻¹ K), cable stiffness.
double cableArmRate(const robot::Description& robot);

/// The filter's process model, UKF paper (5)–(10): x = [q1 dq1 q2 dq2 q3 dq3], driven by motor position and
/// velocity, which are measured and linear in between. Classical RK4, with enough sub-steps for stability:
/// steps = ceil(dt · rate / 2), for RK4 is stable up to |λ| dt = 2.78. All 13 sigma points advance side by
/// side (cable_arm_kernel.h).
///
/// Points beyond a box of believable states (joint limits widened by their own range, ten times the largest
/// speeds) are put on its face: a filter that starts with metres of uncertainty stays finite and finds back;
/// otherwise the box is never touched.
///
/// A joint whose motor is unknown moves as UnknownMotion says, and the force of its cable follows from that
/// (CableArmUnknown); the other joints keep their cables, through which, for want of motor 1 or 2, they also
/// determine its joint as far as they can: cable 2 ties C01 q1 + q2, cable 3 ties C02 q1 + C12 q2 + q3.
///
/// A robot file's effects act: those that the model's numbers can hold (robot::foldEffects()) in them, others
/// through the laws of robot/chain (ExtendedArmModel). What cables remember comes with the control, and
/// remember() sets its next value. While a motor is unknown, the numbers alone act. encoder_slip,
/// zero_drift and the cameras' effects are not the arm's. A StateModel and SampledStateModel; copyable;
/// thread-safe when const.
class CableArmModel {
 public:
  static constexpr int kStates = 6;
  using Control = MotorState;
  using Input = CableArmInput;
  using State = Eigen::Matrix<double, 6, 1>;
  using Points = estimation::SigmaPoints<kStates>;
  using Density = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

  /// Throws base::InputError for a robot of another kind, also one that is not cable-driven.
  explicit CableArmModel(const robot::Description& robot,
                         math::InstructionSet set = math::bestInstructionSet());

  static Input interval(const Control& start, const Control& end);
  static Control between(const Control& start, const Control& end, double fraction);

  void propagate(Points& points, const Input& input, double dt) const {
    if (input.unknown != 0) return propagateUnknown(points, input, dt);
    if (extended_) return extended_->propagate(points, input, input.memory, dt);
    kernel_->propagate(constants_, input, dt, stepsFor(dt), points.data());
  }
  /// One state instead of sigma points.
  State propagateOne(const State& x, const Input& input, double dt) const;

  /// What the cables of a robot with effects remember behind a step of the state x.
  CableMemory remember(const State& x, const Input& input, double dt) const;
  /// Null: the robot has no effects beyond numbers.
  const ExtendedArmModel* extended() const { return extended_.get(); }

  /// Sub-steps taken for dt, at least 1.
  int stepsFor(double dt) const;
  /// Fixes the number of sub-steps (comparisons and benchmarks); 0: as the rate demands.
  void setSteps(int steps) { fixed_steps_ = steps; }

  const CableArmConstants& constants() const { return constants_; }
  /// Parameters changed at run time (identification): radius, stiffness, damping and the rest are plain
  /// fields. `rate` bounds the eigenvalues with the new values, as cableArmRate() does. Only of a model whose
  /// robot has no extended().
  void setConstants(const CableArmConstants& constants, double rate) {
    CAPSTAN_ASSERT(!extended_);
    constants_ = constants;
    rate_ = rate;
  }
  double rate() const { return rate_; }

  void setUnknownMotion(const UnknownMotion& motion) { unknown_motion_ = motion; }
  /// `density`, a square root of the process noise per second with everything known, with the random
  /// acceleration of unknown joints in place of theirs.
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

/// Carries what cables remember from motor sample to motor sample, along the filter's mean.
class RememberedCables {
 public:
  RememberedCables() = default;
  explicit RememberedCables(const MotorState& first) : driven_(first) {}

  /// What they remember at the sample `now`, `dt` after the one before, where the mean was x.
  CableMemory advance(const CableArmModel& model, const CableArmModel::State& x, const MotorState& now,
                      double dt) {
    const CableMemory memory = model.remember(x, CableArmModel::interval(driven_, now), dt);
    driven_ = now;
    driven_.memory = memory;
    return memory;
  }
  /// The motors of the last sample are corrected otherwise from now on.
  void correct(const MotorCorrection& correction) { driven_.correction = correction; }

 private:
  MotorState driven_;
};

}  // namespace capstan::tracking
