#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/robot/chain/chain_numbers.h"
#include "core/robot/description.h"
#include "core/robot/effects.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// How the cameras measure a point p of frame 0: scale · R p + offset, of an instant `delay` earlier (a
/// similarity, Horn, JOSA A 4, 1987).
struct CameraNumbers {
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< rotation vector [rad]
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();    ///< [m]
  double scale = 0.0;                                  ///< share beyond 1
  double delay = 0.0;                                  ///< [s]

  Eigen::Vector3d measure(const Eigen::Vector3d& point) const;
  /// The point of a measurement.
  Eigen::Vector3d undo(const Eigen::Vector3d& measured) const;
  /// Covariance of the point by that of the measurement.
  Eigen::Matrix3d undo(const Eigen::Matrix3d& covariance) const;
};

/// A chain in the form that ChainStep runs: the nominal numbers of a robot file, and effects put into them.
struct ChainModel {
  ChainShape shape;
  ChainNumbers<double> numbers{};
  CameraNumbers camera;
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();  ///< in the last driven joint's frame [m]

  /// Effects of the description are put in.
  explicit ChainModel(const Description& description);
  /// base::InputError: an unknown effect, joint or parameter.
  void add(const Effect& effect);
};

/// Law that an effect needs at its joint; 0: it changes numbers alone.
unsigned lawOf(std::string_view effect);

/// M(q) of the bodies and of inertia that was added at the joints [kg·m², kg·m, kg]; motors of rigid drives
/// are not in it.
JointMatrix massMatrix(const ChainModel& model, const JointVector& q);

/// Upper bound [1/s] on the chain's eigenvalues λ, of pose `q` and at rest, friction at its steepest,
/// without gravity's own stiffness: for M λ² + D λ + K with symmetric parts |λ| is at most the largest
/// eigenvalue of M⁻¹ D or the root of that of M⁻¹ K, whichever is larger. Runge–Kutta steps shorter than 2.7
/// over it are stable.
double chainRate(const ChainModel& model, const JointVector& q);
/// The same of what ChainStep's Jacobian does not have: springs, and the damping of compliant motors. Its
/// steps should be shorter than 0.7 over it.
double chainOscillation(const ChainModel& model, const JointVector& q);

}  // namespace capstan::robot
