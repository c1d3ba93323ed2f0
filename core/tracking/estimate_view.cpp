#include "core/tracking/estimate_view.h"

#include <limits>

#include "core/robot/cable.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Snapshot emptySnapshot() {
  Snapshot s;
  for (Vector3d* v : {&s.q_motor, &s.dq_motor, &s.q_link_kin, &s.q_link_cam, &s.q_link_cam_sigma,
                      &s.q_link_ukf, &s.dq_link_ukf, &s.q_link_ukf_sigma, &s.q_link_true, &s.q_link_true_cam,
                      &s.cable_stretch, &s.cable_tension, &s.tip_in_camera, &s.tip_cam, &s.tip_kin_cam,
                      &s.tip_kin, &s.tip_ukf, &s.innovation, &s.innovation_sigma})
    v->setConstant(kNan);
  s.tip_in_camera_covariance.setConstant(kNan);
  s.tip_ukf_covariance.setConstant(kNan);
  s.t_cam = s.latency = s.nis = s.nis_mean = s.nees = kNan;
  return s;
}

EstimateView::EstimateView(const robot::Description& robot, const ExtendedArmModel* extended)
    : robot_(robot), extended_(extended), arm_(robot), cables_(robot::Transmission(robot)) {}

void EstimateView::show(const CableArmModel::State& mean, const Eigen::Matrix<double, 6, 6>& covariance,
                        const MotorSide& motors, const EncoderWatch& watch, Snapshot& snapshot) {
  snapshot.q_motor = motors.measured().position;
  snapshot.dq_motor = motors.measured().velocity;
  snapshot.q_link_kin = motors.kinematic();
  snapshot.tip_kin = arm_.tip(motors.kinematic());
  for (int joint = 0; joint < 3; ++joint) {
    snapshot.q_link_ukf(joint) = mean(2 * joint);
    snapshot.dq_link_ukf(joint) = mean(2 * joint + 1);
    for (int other = 0; other < 3; ++other)
      position_covariance_(joint, other) = covariance(2 * joint, 2 * other);
  }
  snapshot.q_link_ukf_sigma = position_covariance_.diagonal().cwiseSqrt();
  showCables(motors, snapshot);
  const Matrix3d jacobian = arm_.tipJacobian(snapshot.q_link_ukf);
  snapshot.tip_ukf = arm_.tip(snapshot.q_link_ukf);
  snapshot.tip_ukf_covariance = jacobian * position_covariance_ * jacobian.transpose();
  if (watch.unknown() != 0) showUnknown(motors, watch, snapshot);
}

void EstimateView::showCables(const MotorSide& motors, Snapshot& snapshot) const {
  const robot::Transmission& cables = motors.transmission();
  snapshot.cable_stretch = Vector3d(cables.motorTravel(correction_.position(motors.position()))) -
                           Vector3d(cables.linkTravel(snapshot.q_link_ukf));
  const Vector3d rate = Vector3d(cables.motorTravel(correction_.velocity(motors.velocity()))) -
                        Vector3d(cables.linkTravelRate(snapshot.dq_link_ukf));
  for (int joint = 0; joint < 3; ++joint) {
    const robot::Drive& drive = robot_.drives[static_cast<std::size_t>(joint)];
    snapshot.cable_tension(joint) =
        extended_ ? extended_->tension(joint, snapshot.cable_stretch(joint), rate(joint),
                                       snapshot.q_link_ukf(joint), memory_)
                  : robot::cableForce(drive.cable_stiffness, drive.cable_exponent, drive.cable_damping,
                                      snapshot.cable_stretch(joint), rate(joint));
  }
}

void EstimateView::showUnknown(const MotorSide& motors, const EncoderWatch& watch, Snapshot& snapshot) const {
  const Vector3d known = cables_.given(motors.kinematic(), watch.unknown(), snapshot.q_link_ukf);
  snapshot.q_link_kin = known;
  snapshot.tip_kin = arm_.tip(known);
  for (int motor = 0; motor < 3; ++motor) {
    if (!contains(watch.unknown(), motor)) continue;
    snapshot.q_link_kin(motor) = kNan;
    snapshot.cable_stretch(motor) = snapshot.cable_tension(motor) = kNan;
  }
}

}  // namespace capstan::tracking
