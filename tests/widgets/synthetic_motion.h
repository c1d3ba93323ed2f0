#pragma once

#include <cmath>

#include "core/tracking/snapshot.h"

namespace capstan::widgets {

/// A made-up snapshot at time t: three sinusoids, kinematics off by a constant, camera every 66 ms with a
/// small ripple, occluded between 6 s and 8 s of every ten. Every value is a closed form of t.
inline tracking::Snapshot syntheticSnapshot(double t) {
  tracking::Snapshot s;
  s.t = t;
  s.motor_samples = static_cast<std::uint64_t>(std::llround(t * 1e3)) + 1;
  const Eigen::Vector3d truth(0.8 + 0.3 * std::sin(0.9 * t), 1.5 + 0.25 * std::sin(1.3 * t + 1.0),
                              0.40 + 0.05 * std::sin(1.7 * t + 2.0));
  s.q_link_true = truth;
  s.q_link_true_cam = truth;
  s.q_link_kin = truth + Eigen::Vector3d(0.023, -0.010, 0.0020);
  s.q_link_ukf = truth + Eigen::Vector3d(0.002, 0.001, 0.0003) * std::sin(7.0 * t);
  s.q_link_ukf_sigma = Eigen::Vector3d(0.004, 0.003, 0.0006);
  s.q_link_cam = truth + Eigen::Vector3d(0.012, 0.009, 0.002) * std::sin(90.0 * t);
  s.q_link_cam_sigma = Eigen::Vector3d(0.01, 0.01, 0.002);
  const auto milliseconds = static_cast<long>(std::llround(t * 1e3));
  s.camera_updated = milliseconds % 66 == 0;
  s.t_cam = t;
  s.camera_samples = static_cast<std::uint64_t>(milliseconds / 66 + 1);
  const bool occluded = std::fmod(t, 10.0) >= 6.0 && std::fmod(t, 10.0) < 8.0;
  s.gate = occluded ? tracking::Gate::kLeftLost : tracking::Gate::kOpen;
  s.nis = s.nis_mean = 1.02;
  return s;
}

}  // namespace capstan::widgets
