// How the plant goes through time: Runge–Kutta steps, their length, and the energy that they keep.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/support/planted/plant.h"

namespace capstan::test {
namespace {

/// s + h d, of the joints in use.
PlantState moved(const PlantState& s, double h, const PlantState& d, int n) {
  PlantState out = s;
  for (std::size_t b = 0; b < kBlocks; ++b)
    for (int i = 0; i < n; ++i) out[b][i] += h * d[b][i];
  return out;
}

/// Measured motors at the share x of a step of `duration`: the cubic through both ends and their velocities.
void placeMotors(PlantState& s, const PlantInput& input, double x, double duration, int n) {
  if (!input.motor) return;
  const double x2 = x * x, x3 = x2 * x;
  for (int i = 0; i < n; ++i) {
    const double p = (*input.motor)[i], p_end = (*input.motor_end)[i];
    const double m = (*input.motor_rate)[i] * duration, m_end = (*input.motor_rate_end)[i] * duration;
    s[kMotor][i] =
        (2 * x3 - 3 * x2 + 1) * p + (x3 - 2 * x2 + x) * m + (3 * x2 - 2 * x3) * p_end + (x3 - x2) * m_end;
    s[kMotorRate][i] =
        ((6 * x2 - 6 * x) * (p - p_end) + (3 * x2 - 4 * x + 1) * m + (3 * x2 - 2 * x) * m_end) / duration;
  }
}

/// 1 / (M⁻¹)_ii: what joint i feels when the others are free to yield.
double freeInertia(const RigidChain::Matrix& mass, int i, int n) {
  Joints unit{};
  unit[i] = 1.0;
  return 1.0 / solveSymmetric(mass, unit, n)[i];
}

}  // namespace

void Plant::advance(PlantState& s, double t, double duration, int steps, const PlantInput& input) {
  const double h = duration / steps;
  const int n = p_.size;
  Bodies held;
  const auto slopeAt = [&](const PlantState& at, double time) {
    return p_.rigid ? slope(at, time, input) : slopeWith(held, at, time, input);
  };
  for (int k = 0; k < steps; ++k) {
    const double at = k * h;
    if (!p_.rigid) {
      Joints middle = s[kJoint];
      for (int i = 0; i < n; ++i) middle[i] += 0.5 * h * s[kJointRate][i];
      held = bodiesAt(middle, s[kJointRate]);
    }
    placeMotors(s, input, at / duration, duration, n);
    const PlantState d1 = slopeAt(s, t + at);
    PlantState half = moved(s, 0.5 * h, d1, n);
    placeMotors(half, input, (at + 0.5 * h) / duration, duration, n);
    const PlantState d2 = slopeAt(half, t + at + 0.5 * h);
    half = moved(s, 0.5 * h, d2, n);
    placeMotors(half, input, (at + 0.5 * h) / duration, duration, n);
    const PlantState d3 = slopeAt(half, t + at + 0.5 * h);
    PlantState end = moved(s, h, d3, n);
    placeMotors(end, input, (at + h) / duration, duration, n);
    const PlantState d4 = slopeAt(end, t + at + h);
    for (std::size_t b = 0; b < kBlocks; ++b)
      for (int i = 0; i < n; ++i)
        s[b][i] += h / 6.0 * (d1[b][i] + 2.0 * d2[b][i] + 2.0 * d3[b][i] + d4[b][i]);
  }
  placeMotors(s, input, 1.0, duration, n);
}

double Plant::fastestRate(int i, const PlantState& s) const {
  RigidChain chain = p_.chain;
  chain.pose(s[kJoint]);
  RigidChain::Matrix mass = chain.massMatrix();
  for (int j = 0; j < p_.size; ++j) mass[j][j] += p_.armature[j];
  const double inertia = freeInertia(mass, i, p_.size);
  const double tiny = 1e-6 * p_.smoothing[i];
  const double weight = std::abs(chain.bias(Joints{})[i]) + 2.0 * p_.coulomb[i];
  double damping = std::max(jointFriction(i, s[kJoint][i], tiny, weight) / tiny,
                            jointFriction(i, s[kJoint][i], -tiny, weight) / -tiny);
  double spring = 0.0, motor = 0.0;
  for (int j = 0; j < p_.size; ++j) {
    const double lever = p_.radius[j] * p_.coupling[j][i], motor_lever = p_.capstan[j] / p_.gear[j];
    if (stiff(j) || lever == 0.0) continue;
    const double k = p_.rigid ? 1.0 / p_.compliance[j] : 2.0 * p_.stiffness[j] * p_.exponent[j];
    const double b = p_.rigid ? 0.2 * std::sqrt(k * p_.motor_inertia[j]) / motor_lever : 2.0 * p_.damping[j];
    damping += lever * lever * b;
    spring += lever * lever * k;
    const double i_m = p_.motor_inertia[j];
    motor = std::max(motor, (p_.motor_coulomb[j] / p_.motor_smoothing[j] + p_.motor_viscous[j] +
                             motor_lever * motor_lever * b) /
                                    i_m +
                                motor_lever * std::sqrt(k / i_m));
  }
  return std::max(damping / inertia + std::sqrt(spring / inertia), motor);
}

int Plant::stepsFor(double duration, const Joints& q) {
  double fastest = 0.0;
  PlantState s{};
  for (const double shift : {-0.5, 0.0, 0.5}) {  // of the ranges: inertia changes with the pose
    for (int i = 0; i < p_.size; ++i) s[kJoint][i] = q[i] + shift * p_.half_range[i];
    for (int i = 0; i < p_.size; ++i) fastest = std::max(fastest, fastestRate(i, s));
  }
  const double limit = 1.4;  // half of what RK4 bears on the negative real axis, 2.78
  const double steps = std::max(std::ceil(duration / 0.5e-3), std::ceil(duration * fastest / limit));
  if (steps > 1e6 * duration)
    throw TooStiff("this robot is too stiff for the planted plant: its fastest rate is " +
                   std::to_string(fastest) + " 1/s");
  return p_.refinement * static_cast<int>(steps);
}

double Plant::energy(const PlantState& s) {
  p_.chain.pose(s[kJoint]);
  double total = p_.chain.energy(s[kJointRate]);
  for (int i = 0; i < p_.size; ++i) {
    const CableState cable = cableState(i, s, 0.0);
    const double ratio = p_.gear[i] / p_.capstan[i];
    const double rate = stiff(i) ? ratio * (cable.travel_rate - cable.rate) : s[kMotorRate][i];
    total += 0.5 * p_.motor_inertia[i] * rate * rate;
    total += 0.5 * p_.armature[i] * s[kJointRate][i] * s[kJointRate][i];
    if (stiff(i)) continue;
    const double a = p_.exponent[i];
    total += p_.rigid ? 0.5 / p_.compliance[i] * cable.stretch * cable.stretch
                      : 2.0 * p_.stiffness[i] / a * (std::cosh(a * cable.stretch) - 1.0);
  }
  return total;
}

}  // namespace capstan::test
