#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <variant>

/// Samples that a source yields. t [s] is the time of the measurement on the session's own clock, which
/// starts near 0; t_arrival >= t [s] is the time of arrival at the computer. Samples come in order of
/// arrival.
namespace capstan::tracking {

/// Motor encoder sample, 1 kHz. Torque and velocity are NaN where they are not measured; the pipeline then
/// differentiates the position.
struct MotorSample {
  double t = 0.0;
  Eigen::Vector3d position;  ///< q_m from the hard stop [rad]
  Eigen::Vector3d velocity;  ///< dq_m [rad/s]
  Eigen::Vector3d torque;    ///< commanded tau_m [N·m]
};

/// A pair of 8-bit BGR images exposed at t. An image is empty where its camera gave none.
struct StereoFrame {
  double t = 0.0;
  double t_arrival = 0.0;
  cv::Mat left, right;
  /// Exposure of the right image minus that of the left [s]; NaN: not known, as in recordings.
  double skew = std::numeric_limits<double>::quiet_NaN();
  /// Left, right: the view was blocked deliberately (Source::block()), now or when it was recorded.
  std::array<bool, 2> blocked{};
};

/// Tip position in frame 0 from cameras of another system, for recordings without images. NaN: tip not
/// visible.
struct TipSample {
  double t = 0.0;
  double t_arrival = 0.0;
  Eigen::Vector3d position;  ///< [m]
};

/// Joint encoder sample: the reference. It is used for statistics and views only, never as input of an
/// estimator.
struct JointSample {
  double t = 0.0;
  Eigen::Vector3d position;  ///< [rad, rad, m]
};

using Sample = std::variant<MotorSample, StereoFrame, TipSample, JointSample>;

}  // namespace capstan::tracking
