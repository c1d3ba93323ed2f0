#include "core/robot/transmission.h"

#include <Eigen/LU>

#include "core/base/check.h"

namespace capstan::robot {

Transmission::Transmission(const Description& description) {
  const int n = description.size();
  CAPSTAN_CHECK(n >= 1 && n <= kMaxJoints);
  homing_.resize(n);
  motor_radius_.resize(n);
  link_radius_.resize(n);
  coupling_ = couplingMatrix(description);
  for (int i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Drive& drive = description.drives[at];
    homing_[i] = description.joints[at].homing;
    motor_radius_[i] = drive.motor_capstan_radius / drive.gear_ratio;
    link_radius_[i] = drive.link_radius;
  }
  coupling_inverse_ = coupling_.inverse();
}

JointVector Transmission::linkTravel(const JointVector& q) const {
  const JointVector from_stop = q - homing_;
  return linkTravelRate(from_stop);
}

JointVector Transmission::linkTravelRate(const JointVector& dq) const {
  return link_radius_.cwiseProduct(coupling_.lazyProduct(dq));
}

JointVector Transmission::jointFromMotor(const JointVector& q_m) const {
  return homing_ + jointVelocityFromMotor(q_m);
}

JointVector Transmission::jointVelocityFromMotor(const JointVector& dq_m) const {
  const JointVector turn = motorTravel(dq_m).cwiseQuotient(link_radius_);
  return coupling_inverse_.lazyProduct(turn);
}

JointVector Transmission::motorFromJoint(const JointVector& q) const {
  return linkTravel(q).cwiseQuotient(motor_radius_);
}

JointVector Transmission::motorVelocityFromJoint(const JointVector& dq) const {
  return linkTravelRate(dq).cwiseQuotient(motor_radius_);
}

JointVector Transmission::jointTorque(const JointVector& cable_force) const {
  const JointVector pull = link_radius_.cwiseProduct(cable_force);
  return coupling_.transpose().lazyProduct(pull);
}

}  // namespace capstan::robot
