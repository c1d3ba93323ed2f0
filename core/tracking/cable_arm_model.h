#pragma once

#include <Eigen/Core>

#include "core/estimation/models.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::tracking {

/// A motor sample as the filter takes it: q_m from the hard stop [rad], dq_m [rad/s].
struct MotorState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
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
/// otherwise the box is never touched. A StateModel and SampledStateModel; copyable plain data; thread-safe
/// when const.
class CableArmModel {
 public:
  static constexpr int kStates = 6;
  using Control = MotorState;
  using Input = CableArmDrive;
  using State = Eigen::Matrix<double, 6, 1>;
  using Points = estimation::SigmaPoints<kStates>;

  /// Throws base::InputError for a robot of another kind.
  explicit CableArmModel(const robot::Description& robot,
                         math::InstructionSet set = math::bestInstructionSet());

  static Input interval(const Control& start, const Control& end);
  static Control between(const Control& start, const Control& end, double fraction);

  void propagate(Points& points, const Input& input, double dt) const {
    kernel_->propagate(constants_, input, dt, stepsFor(dt), points.data());
  }
  /// One state instead of sigma points.
  State propagateOne(const State& x, const Input& input, double dt) const;

  /// Sub-steps taken for dt, at least 1.
  int stepsFor(double dt) const;
  /// Fixes the number of sub-steps (comparisons and benchmarks); 0: as the rate demands.
  void setSteps(int steps) { fixed_steps_ = steps; }

  const CableArmConstants& constants() const { return constants_; }
  /// Parameters changed at run time (identification): radius, stiffness, damping and the rest are plain
  /// fields. `rate` bounds the eigenvalues with the new values, as cableArmRate() does.
  void setConstants(const CableArmConstants& constants, double rate) {
    constants_ = constants;
    rate_ = rate;
  }
  double rate() const { return rate_; }

 private:
  CableArmConstants constants_;
  const CableArmKernel* kernel_;
  double rate_;
  int fixed_steps_ = 0;
};

}  // namespace capstan::tracking
