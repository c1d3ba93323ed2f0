#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/tracking/cable_arm_kernel.h"

namespace capstan::identification {

/// Discrepancy of the model: unknown forces on every joint, with a standard deviation that is a share of its
/// Coulomb friction. The first force (breakaway friction, load) is constant over kMemory and then takes
/// another value. The second force (hysteresis of the cable) follows the cable's stretch and slips, with the
/// same law over the whole recording. Without these forces, a long recording with precise cameras would state
/// a stiffness or damping more precisely than the friction law is known.
struct ModelDiscrepancy {
  double friction_share = 0.3;  ///< standard deviation of each force / F_cl; as the prior of friction
  static constexpr double kMemory = 5.0;  ///< time over which the first force is constant [s]
};

/// Compliance d q / d tau of joints held by their cables [rad or m per N·m or N]: (Aᵀ diag(2 k_e a r_l²)
/// A)⁻¹, UKF paper (5)–(7) linearized about unstretched cables.
inline Eigen::Matrix3d cableCompliance(const tracking::CableArmConstants& c) {
  Eigen::Matrix3d coupling;
  Eigen::Vector3d stiffness;
  for (int i = 0; i < 3; ++i) {
    stiffness(i) = 2.0 * c.stiffness[i] * c.exponent[i] * c.link_radius[i] * c.link_radius[i];
    for (int j = 0; j < 3; ++j) coupling(i, j) = c.coupling[i][j];
  }
  return (coupling.transpose() * stiffness.asDiagonal() * coupling).inverse();
}

/// Joint errors [rad, rad, m]. Column j: effect of an unknown force of one standard deviation on joint j.
inline Eigen::Matrix3d errorByDiscrepancy(const tracking::CableArmConstants& c,
                                          const ModelDiscrepancy& discrepancy) {
  const Eigen::Vector3d force =
      discrepancy.friction_share * Eigen::Vector3d(c.coulomb[0], c.coulomb[1], c.coulomb[2]);
  return cableCompliance(c) * force.asDiagonal();
}

/// Joint errors [rad, rad, m]. Column j: effect of an unknown hysteresis of one standard deviation in cable
/// j, which acts on the joints through the transpose of the coupling. `hysteresis` is that of ArmPrediction.
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
