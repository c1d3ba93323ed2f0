#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/robot/chain/chain_numbers.h"
#include "core/robot/description.h"
#include "core/robot/effects.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// Camera model: a point p in frame 0 is measured as (1 + scale) R p + offset, with a delay (similarity
/// transform; Horn, JOSA A 4, 1987).
struct CameraNumbers {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< rotation vector [rad]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();    ///< offset in frame 0 [m]
  double scale = 0.0;                                  ///< scale factor minus 1
  double delay = 0.0;                                  ///< age of the point at its time stamp [s]

  Eigen::Vector3d measure(const Eigen::Vector3d& point) const;
  /// Point in frame 0 of a measurement [m].
  Eigen::Vector3d undo(const Eigen::Vector3d& measured) const;
  /// Covariance of the point from the covariance of the measurement [m²].
  Eigen::Matrix3d undo(const Eigen::Matrix3d& covariance) const;
};

/// Model of a chain in the form that ChainStep needs: the nominal numbers of a robot file with added effects.
struct ChainModel {
  ChainShape shape;
  ChainNumbers<double> numbers{};
  CameraNumbers camera;
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();  ///< in the last driven joint's frame [m]

  /// Adds all effects of the description.
  explicit ChainModel(const Description& description);
  /// Adds one effect. A homing offset at a motor uses the coupling so far: add couplings first. Throws
  /// base::InputError for an unknown effect, joint or parameter.
  void add(const Effect& effect);
};

/// Coupling matrix A with the effects of the model.
JointMatrix couplingMatrix(const ChainModel& model);

/// ChainLaw bit that an effect needs at its joint; 0 when it only changes numbers.
unsigned lawOf(std::string_view effect);

/// Change of all q_hs [rad or m] by a homing error `offset` of joint i (from 0), with the coupling A. An
/// error at the joint (at_motor = 0) moves q_hs of this joint. An error of the motor's zero (at_motor = 1)
/// moves the zero of this cable alone, which is the shift h of all joints with A h = A(i, i) offset e_i.
/// Values between are interpolated.
JointVector homingShift(const JointMatrix& coupling, int i, double offset, double at_motor);

/// Mass matrix M(q) of the bodies and of inertia that was added at the joints [kg·m², kg·m, kg], without the
/// motors of rigid drives.
JointMatrix massMatrix(const ChainModel& model, const JointVector& q);

/// Upper bound [1/s] on the magnitude of the chain's eigenvalues λ at rest at `q`, with the steepest friction
/// and without the stiffness of gravity. For M λ² + D λ + K with symmetric matrices, |λ| is at most the
/// larger of the largest eigenvalue of M⁻¹ D and the square root of that of M⁻¹ K. Runge–Kutta steps shorter
/// than 2.7 / bound are stable.
double chainRate(const ChainModel& model, const JointVector& q);
/// Upper bound [1/s], as chainRate(), for the parts that ChainStep's Jacobian does not contain: cables with
/// hysteresis, the springs of rigid drives, and the damping of compliant motors. The steps of ChainStep
/// should be shorter than 0.7 / bound.
double chainOscillation(const ChainModel& model, const JointVector& q);

}  // namespace capstan::robot
