#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <variant>

/// What a source yields. Time t [s] is the instant that the sample speaks of, on the session's own clock,
/// starting near 0; t_arrival >= t is when it reached the computer. Samples come in order of arrival.
namespace capstan::tracking {

/// Motor encoders, 1 kHz. Unmeasured torque and velocity are NaN; the pipeline differentiates a missing
/// velocity.
struct MotorSample {
  double t = 0.0;
  Eigen::Vector3d position;  ///< q_m from the hard stop [rad]
  Eigen::Vector3d velocity;  ///< dq_m [rad/s]
  Eigen::Vector3d torque;    ///< tau_m, command [N·m]
};

/// A pair of 8-bit BGR images exposed at t. An empty image: that camera gave none.
struct StereoFrame {
  double t = 0.0;
  double t_arrival = 0.0;
  cv::Mat left, right;
};

/// Tip position from cameras of another system, in frame 0, where a recording holds no images. NaN: not seen.
struct TipSample {
  double t = 0.0;
  double t_arrival = 0.0;
  Eigen::Vector3d position;  ///< [m]
};

/// Joint encoders: the reference. Never an input of an estimator; statistics and views only.
struct JointSample {
  double t = 0.0;
  Eigen::Vector3d position;  ///< [rad, rad, m]
};

using Sample = std::variant<MotorSample, StereoFrame, TipSample, JointSample>;

}  // namespace capstan::tracking
