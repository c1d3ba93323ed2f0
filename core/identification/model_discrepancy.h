#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/tracking/cable_arm_kernel.h"

namespace capstan::identification {

/// Discrepancy of the model itself: every joint may feel forces that no part of the model knows, of a
/// standard deviation that is a share of its Coulomb friction. One (breakaway friction, load) stays for a
/// while and then is another. One (hysteresis of the cable) follows the cable's stretch and slips, the
/// same all through a recording: half a spring, half a damper. Without them a long recording with fine
/// cameras would state a stiffness or a damping more closely than the friction law is known.
struct ModelDiscrepancy {
  double friction_share = 0.3;  ///< standard deviation of each force by F_cl: what priors say of friction
  double memory = 5.0;          ///< how long the first one stays [s]
};

/// d q / d tau of a joint held by its cables [rad or m per N·m or N]: (Aᵀ diag(2 k_e a r_l²) A)⁻¹, UKF paper
/// (5)–(7) about unstretched cables.
inline Eigen::Matrix3d cableCompliance(const tracking::CableArmConstants& c) {
  Eigen::Matrix3d coupling;
  Eigen::Vector3d stiffness;
  for (int i = 0; i < 3; ++i) {
    stiffness(i) = 2.0 * c.stiffness[i] * c.exponent[i] * c.link_radius[i] * c.link_radius[i];
    for (int j = 0; j < 3; ++j) coupling(i, j) = c.coupling[i][j];
  }
  return (coupling.transpose() * stiffness.asDiagonal() * coupling).inverse();
}

/// Joint errors [rad, rad, m] by an unknown force of one standard deviation on each joint, columns.
inline Eigen::Matrix3d errorByDiscrepancy(const tracking::CableArmConstants& c,
                                          const ModelDiscrepancy& discrepancy) {
  const Eigen::Vector3d force =
      discrepancy.friction_share * Eigen::Vector3d(c.coulomb[0], c.coulomb[1], c.coulomb[2]);
  return cableCompliance(c) * force.asDiagonal();
}

/// The same by an unknown hysteresis of one standard deviation in each cable, columns, `hysteresis` as in
/// ArmPrediction: a joint feels it through the transpose of the coupling.
inline Eigen::Matrix3d errorByHysteresis(const tracking::CableArmConstants& c,
                                         const ModelDiscrepancy& discrepancy,
                                         const Eigen::Vector3d& hysteresis) {
  Eigen::Matrix3d by_cable;
  for (int cable = 0; cable < 3; ++cable)
    for (int joint = 0; joint < 3; ++joint)
      by_cable(joint, cable) =
          c.coupling[cable][joint] * discrepancy.friction_share * c.coulomb[cable] * hysteresis(cable);
  return cableCompliance(c) * by_cable;
}

}  // namespace capstan::identification
