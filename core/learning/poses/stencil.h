#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

/// Velocities by the five-point stencil (GPR paper, section V-B), for stamps with any spacing.
namespace capstan::learning {

inline constexpr std::size_t kStencil = 5;

/// Weights of the values at `t` in the derivative at `at` of their interpolation polynomial (Fornberg,
/// Generation of finite difference formulas on arbitrarily spaced grids, Mathematics of Computation 51
/// (1988)). Stamps may have any order; no two may be equal.
std::vector<double> derivativeWeights(std::span<const double> t, double at);

/// Velocity [m/s] at each stamp from the positions [m] at the five nearest stamps, at the ends from the first
/// or last five. With fewer than five poses all are used; for a single pose the velocity is 0. Stamps must
/// strictly increase [s].
Eigen::Matrix3Xd velocitiesOf(std::span<const double> t, const Eigen::Matrix3Xd& positions);

/// Angular velocity in the rotated frame [rad/s] at each stamp, as velocitiesOf(): derivative of the rotation
/// vector from each rotation to its neighbours, which must differ by less than π.
Eigen::Matrix3Xd angularVelocitiesOf(std::span<const double> t, std::span<const Eigen::Quaterniond> turns);

}  // namespace capstan::learning
