#pragma once

#include <array>
#include <cmath>

#include "core/robot/arm_kernel.h"
#include "core/tracking/cable_arm_kernel.h"

/// The filter's process model for any scalar: what core/tracking's SIMD kernels compute for doubles, for
/// automatic differentiation with respect to the cable parameters.
namespace capstan::identification {

/// r_l, k_e, b_e and F_cl as T; everything else as in `robot`.
template <class T>
struct LinkParameters {
  const tracking::CableArmConstants& robot;
  std::array<T, 3> link_radius, stiffness, damping, coulomb;
};

template <class T>
struct LinkState {
  std::array<T, 3> q, dq;
};

/// Motor cable travel s_m [m] at the start of a step and its constant rate over it [m/s].
struct MotorStep {
  std::array<double, 3> travel, rate;
};

/// ddq of UKF paper (5)–(8) with the motors' cable travel [m] and its rate at one instant.
template <class T>
std::array<T, 3> linkAcceleration(const LinkParameters<T>& p, const std::array<double, 3>& travel,
                                  const std::array<double, 3>& rate, const LinkState<T>& x) {
  using std::cos;
  using std::sin;
  using std::sinh;
  using std::tanh;
  const tracking::CableArmConstants& c = p.robot;
  std::array<T, 3> tension;  // r_l gamma
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = c.coupling[i];
    T link = row[0] * (x.q[0] - c.homing[0]);
    T speed = row[0] * x.dq[0];
    for (std::size_t j = 1; j < 3; ++j) {
      if (row[j] == 0.0) continue;
      link += row[j] * (x.q[j] - c.homing[j]);
      speed += row[j] * x.dq[j];
    }
    const T stretch = travel[i] - p.link_radius[i] * link;
    const T stretch_rate = rate[i] - p.link_radius[i] * speed;
    tension[i] = p.link_radius[i] *
                 (2.0 * p.stiffness[i] * sinh(c.exponent[i] * stretch) + 2.0 * p.damping[i] * stretch_rate);
  }
  std::array<T, 3> tau;
  for (std::size_t j = 0; j < 3; ++j)
    tau[j] = c.coupling[0][j] * tension[0] + c.coupling[1][j] * tension[1] + c.coupling[2][j] * tension[2] -
             p.coulomb[j] * tanh(c.inverse_smoothing[j] * x.dq[j]) - c.viscous[j] * x.dq[j];
  return robot::armForward<T>(c.body, {sin(x.q[0]), cos(x.q[0]), sin(x.q[1]), cos(x.q[1])}, x.q[2], x.dq,
                              tau);
}

/// `steps` classical RK4 steps over dt, in place.
template <class T>
void advanceLink(const LinkParameters<T>& p, const MotorStep& motor, double dt, int steps, LinkState<T>& x) {
  constexpr double kAt[] = {0.0, 0.5, 0.5, 1.0}, kReach[] = {0.5, 0.5, 1.0, 0.0};
  constexpr double kWeight[] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const double h = dt / steps;
  for (int step = 0; step < steps; ++step) {
    const LinkState<T> start = x;
    LinkState<T> stage = x;
    for (int k = 0; k < 4; ++k) {
      std::array<double, 3> travel;
      for (std::size_t i = 0; i < 3; ++i) travel[i] = motor.travel[i] + (step + kAt[k]) * h * motor.rate[i];
      const std::array<T, 3> slope = linkAcceleration(p, travel, motor.rate, stage);
      for (std::size_t i = 0; i < 3; ++i) {
        x.q[i] += (h * kWeight[k]) * stage.dq[i];
        x.dq[i] += (h * kWeight[k]) * slope[i];
      }
      if (k == 3) break;
      for (std::size_t i = 0; i < 3; ++i) {
        const T speed = stage.dq[i];
        stage.q[i] = start.q[i] + (kReach[k] * h) * speed;
        stage.dq[i] = start.dq[i] + (kReach[k] * h) * slope[i];
      }
    }
  }
}

/// Joints and speeds with unstretched cables: A (q − q_hs) = s_m / r_l. `inverse` is A⁻¹, rows.
template <class T>
LinkState<T> unstretched(const LinkParameters<T>& p, const MotorStep& motor,
                         const std::array<std::array<double, 3>, 3>& inverse) {
  LinkState<T> x;
  for (std::size_t i = 0; i < 3; ++i) {
    x.q[i] = T(p.robot.homing[i]);
    x.dq[i] = T(0.0);
    for (std::size_t j = 0; j < 3; ++j) {
      x.q[i] += inverse[i][j] * motor.travel[j] / p.link_radius[j];
      x.dq[i] += inverse[i][j] * motor.rate[j] / p.link_radius[j];
    }
  }
  return x;
}

}  // namespace capstan::identification
