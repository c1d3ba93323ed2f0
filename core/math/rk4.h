#pragma once

namespace capstan::math {

/// Returns x(t + dt) by one step of the classical fourth-order Runge–Kutta method for dx/dt = f(t, x).
/// `State` is a fixed-size Eigen vector or any type with + and * by a scalar; f returns a State.
template <class State, class Scalar, class Derivative>
State rk4Step(Derivative&& f, Scalar t, const State& x, Scalar dt) {
  const Scalar half = dt / Scalar(2);
  const State k1 = f(t, x);
  const State k2 = f(t + half, State(x + k1 * half));
  const State k3 = f(t + half, State(x + k2 * half));
  const State k4 = f(t + dt, State(x + k3 * dt));
  return State(x + (k1 + (k2 + k3) * Scalar(2) + k4) * (dt / Scalar(6)));
}

}  // namespace capstan::math
