#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

/// Velocities by the five-point stencil (GPR paper, section V-B), on stamps that need not be even.
namespace capstan::learning {

inline constexpr std::size_t kStencil = 5;

/// Weights of the values at `t` in the derivative at `at`, of the polynomial through all of them (Fornberg,
/// Generation of finite difference formulas on arbitrarily spaced grids, Mathematics of Computation 51
/// (1988)). Stamps in any order, no two equal.
std::vector<double> derivativeWeights(std::span<const double> t, double at);

/// Velocity [m/s] at each stamp from the positions [m] at the five nearest, at the ends from the first and
/// last five; of fewer than five poses from all of them, of one zero. Stamps rise strictly [s].
Eigen::Matrix3Xd velocitiesOf(std::span<const double> t, const Eigen::Matrix3Xd& positions);

/// Angular velocity in the frame that the rotations lead to [rad/s], likewise: derivative of the rotation
/// vector from each turn to its neighbours. Neighbours turn by less than π.
Eigen::Matrix3Xd angularVelocitiesOf(std::span<const double> t, std::span<const Eigen::Quaterniond> turns);

}  // namespace capstan::learning
