#pragma once

#include <Eigen/Core>

#include "core/robot/description.h"

namespace capstan::robot {

/// Numbers of the RAVEN-II's own control software, converted to those of this project.
///
/// The software states motor positions m in degrees of the motor shaft, with the motor zero at JOINT zero,
/// joint positions in degrees (for the insertion axis: metres times 180/π), and speeds in the same units per
/// second. It computes joints from motors by A q = m / TR, TR = N r / r_mc = 136.196, 121.522, 2158.59 rad/m.
/// Its pulley radius r2 is 56.297 mm; the published model rounds it to 56.298 mm. Here q_m counts from the
/// hard stop, so that the published model's transmission, s_l = r_l ∘ A (q − q_hs) = r_mc q_m / N, gives the
/// same joints:
///
///     q_m = f ∘ (m π/180 − TR ∘ (A q_hs)),   f = (1, 56.298 / 56.297, 1)
///
/// A and q_hs are those of `robot`. Its pulley radii are not used, so that tracking can detect a different
/// radius.
class RavenSoftware {
 public:
  /// `robot` has three joints.
  explicit RavenSoftware(const Description& robot);

  double motorPosition(int motor, double m) const;  ///< q_m [rad] of m [deg]
  double motorSpeed(int motor, double dm) const;    ///< dq_m [rad/s] of dm [deg/s]
  static double joint(double value);                ///< q [rad or m] of a joint position as published

 private:
  Eigen::Vector3d at_stop_;  ///< m at the hard stop [rad]
};

}  // namespace capstan::robot
