#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>

#include "core/base/random.h"
#include "core/base/resource.h"
#include "core/identification/identification_data.h"
#include "core/identification/parameters.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "core/tracking/cable_arm_model.h"

namespace capstan::identification::test {

/// RAVEN-II with cables a fortieth as stiff on joints 2 and 3, so that stretch, damping and friction show in
/// seconds.
inline robot::Description softRaven() {
  robot::Description robot = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  robot.drives[1].cable_stiffness = 2500.0;
  robot.drives[1].cable_damping = 300.0;
  robot.drives[2].cable_stiffness = 500.0;
  robot.drives[2].cable_damping = 60.0;
  return robot;
}

struct RecordingOptions {
  double duration = 30.0;   ///< [s]
  double tip_sigma = 2e-4;  ///< of a seen tip [m]
  CameraPose pose = {};     ///< what the registration does not know
  bool moves = true;
  std::uint64_t seed = 1;
  std::function<Eigen::Vector3d(double)> motion = {};  ///< joints at t [s]; none: a swing
};

/// A recording of an arm that is exactly the filter's model with `truth`, and noise that is exactly as
/// stated. `nominal` is what the identification is told.
inline IdentificationData matchedRecording(const robot::Description& truth, const robot::Description& nominal,
                                           const RecordingOptions& options = {}) {
  const robot::Transmission transmission(nominal);
  const robot::ArmKinematics arm(nominal);
  const tracking::CableArmModel model(truth);
  base::Random random(options.seed, "matched recording");
  IdentificationData data;
  data.title = "matched";
  data.robot = nominal;
  const auto motorAt = [&](double t) {
    if (options.motion) return Eigen::Vector3d(transmission.motorFromJoint(options.motion(t)));
    const double swing = options.moves ? 1.0 : 0.0;
    const Eigen::Vector3d q(0.6 + swing * 0.5 * std::sin(1.3 * t),
                            1.6 + swing * 0.4 * std::sin(1.9 * t + 1.0),
                            0.35 + swing * 0.06 * std::sin(2.7 * t));
    return Eigen::Vector3d(transmission.motorFromJoint(q));
  };
  constexpr double kStep = 1e-3;
  constexpr int kFrameEvery = 33;
  tracking::CableArmModel::State x = tracking::CableArmModel::State::Zero();
  const Eigen::Vector3d start = robot::Transmission(truth).jointFromMotor(motorAt(0.0));
  for (int i = 0; i < 3; ++i) x(2 * i) = start(i);
  const Eigen::Vector3d centre = arm.tip(Eigen::Vector3d(0.6, 1.6, 0.35));
  for (int step = 0; step * kStep <= options.duration; ++step) {
    const double t = step * kStep;
    data.motors.t.push_back(t);
    data.motors.position.push_back(motorAt(t));
    data.motors.velocity.push_back((motorAt(t + kStep) - motorAt(t)) / kStep);
    if (step > 0 && step % kFrameEvery == 0) {
      CameraObservation seen;
      seen.t = t;
      const Eigen::Vector3d q(x(0), x(2), x(4)), dq(x(1), x(3), x(5));
      seen.tip = options.pose.seen(arm.tip(q - options.pose.delay * dq), centre);
      for (int i = 0; i < 3; ++i) seen.tip(i) += random.normal(0.0, options.tip_sigma);
      seen.tip_kin = arm.tip(transmission.jointFromMotor(motorAt(t)));
      seen.tip_covariance = options.tip_sigma * options.tip_sigma * Eigen::Matrix3d::Identity();
      seen.q_cam = arm.solvePosition(seen.tip, q).value_or(q);
      const Eigen::Matrix3d inverse = arm.tipJacobian(seen.q_cam).inverse();
      seen.q_covariance = inverse * seen.tip_covariance * inverse.transpose();
      seen.open = true;
      data.cameras.push_back(seen);
    }
    const Eigen::Vector3d speed = (motorAt(t + kStep) - motorAt(t)) / kStep;
    x = model.propagateOne(
        x, tracking::CableArmModel::interval({motorAt(t), speed}, {motorAt(t + kStep), speed}), kStep);
  }
  return data;
}

}  // namespace capstan::identification::test
