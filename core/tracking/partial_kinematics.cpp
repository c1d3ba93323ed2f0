#include "core/tracking/partial_kinematics.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace capstan::tracking {

using Eigen::Matrix3d;
using Eigen::Vector3d;

JointMeasurement positionsOnly() {
  JointMeasurement measurement;
  for (int joint = 0; joint < 3; ++joint) measurement.h(joint, 2 * joint) = 1.0;
  return measurement;
}

void forgetJoints(JointSet set, const Vector3d& position_sigma, const Vector3d& speed,
                  CableArmModel::State& mean, estimation::Lower<6>& root) {
  Eigen::Matrix<double, 6, 6> covariance = root * root.transpose();
  for (int joint = 0; joint < 3; ++joint) {
    if (!contains(set, joint)) continue;
    const int at = 2 * joint;
    covariance.middleRows<2>(at).setZero();
    covariance.middleCols<2>(at).setZero();
    covariance(at, at) = position_sigma(joint) * position_sigma(joint);
    covariance(at + 1, at + 1) = speed(joint) * speed(joint);
    mean(at + 1) = 0.0;
  }
  root = covariance.llt().matrixL();
}

PartialKinematics::PartialKinematics(const robot::Transmission& transmission)
    : coupling_(transmission.coupling()), coupling_inverse_(coupling_.inverse()) {}

Vector3d PartialKinematics::given(const Vector3d& q_kin, JointSet unknown, const Vector3d& reference) const {
  Vector3d change = coupling_ * (reference - q_kin);
  for (int motor = 0; motor < 3; ++motor)
    if (!contains(unknown, motor)) change(motor) = 0.0;
  return q_kin + coupling_inverse_ * change;
}

KinematicObservation PartialKinematics::observe(const Vector3d& q_kin, JointSet unknown,
                                                const Vector3d& sigma) const {
  if (unknown == 0) return {positionsOnly(), q_kin, estimation::Lower<3>(sigma.asDiagonal())};
  KinematicObservation seen{{}, coupling_ * q_kin, {}};
  Matrix3d covariance = coupling_ * sigma.cwiseAbs2().asDiagonal() * coupling_.transpose();
  for (int motor = 0; motor < 3; ++motor) {
    if (contains(unknown, motor)) {
      seen.y(motor) = 0.0;
      covariance.row(motor).setZero();
      covariance.col(motor).setZero();
      covariance(motor, motor) = 1.0;  // of an empty row: anything regular
      continue;
    }
    for (int joint = 0; joint < 3; ++joint) seen.measurement.h(motor, 2 * joint) = coupling_(motor, joint);
  }
  seen.root = estimation::Lower<3>(covariance.llt().matrixL());
  return seen;
}

}  // namespace capstan::tracking
