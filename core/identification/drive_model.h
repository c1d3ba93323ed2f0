#pragma once

#include <cmath>
#include <vector>

#include "core/identification/drive_recording.h"

namespace capstan::identification {

/// Constants of one drive, SI. T is double, or a number with derivatives (its value in `.a`).
template <class T>
struct DriveLaw {
  double motor_radius = 1.0;       ///< r_mc / N [m]
  double direction = 1.0;          ///< A: sign of cable travel / joint travel; −1 where q falls with q_m
  double motor_smoothing = 0.01;   ///< smoothing speed v_eps of the motor's friction [rad/s]
  double homing = 0.0;             ///< q_hs [rad or m]
  T link_radius;                   ///< r_l [m/rad or m/m]
  T stiffness;                     ///< k_c = 2 k_e a: stiffness of the unstretched cable [N/m]
  T exponent;                      ///< a [1/m]
  T damping;                       ///< b_e [N·s/m]
  T coulomb, viscous;              ///< F_cl, F_vl [N·m or N; times s/rad or s/m]
  T motor_coulomb, motor_viscous;  ///< tau_cm [N·m], tau_vm [N·m·s]
};

template <class T>
struct DrivePrediction {
  std::vector<T> q;      ///< joint position per row of the recording [rad or m]
  std::vector<T> tau_m;  ///< motor torque per row [N·m]
};

namespace drive {

inline double valueOf(double x) { return x; }
template <class T>
double valueOf(const T& x) {
  return x.a;
}

/// Cable force gamma [N], UKF paper (5)–(6).
template <class T>
T cableForce(const DriveLaw<T>& law, const T& stretch, const T& stretch_rate) {
  using std::sinh;
  return law.stiffness / law.exponent * sinh(law.exponent * stretch) + 2.0 * law.damping * stretch_rate;
}

inline DriveLaw<double> valuesOf(const DriveLaw<double>& law) { return law; }
template <class T>
DriveLaw<double> valuesOf(const DriveLaw<T>& law) {
  return {law.motor_radius,           law.direction,
          law.motor_smoothing,        law.homing,
          valueOf(law.link_radius),   valueOf(law.stiffness),
          valueOf(law.exponent),      valueOf(law.damping),
          valueOf(law.coulomb),       valueOf(law.viscous),
          valueOf(law.motor_coulomb), valueOf(law.motor_viscous)};
}

/// One implicit Euler step of the link.
template <class T>
struct Step {
  const DriveLaw<T>& law;
  double q_m, load, h;
  T q_before, stretch_before;  ///< q from the hard stop

  T stretch(const T& q) const { return law.motor_radius * q_m - law.direction * law.link_radius * q; }
  T force(const T& q) const {
    const T now = stretch(q);
    return cableForce(law, now, T((now - stretch_before) / h));
  }
  /// Torque on the link without Coulomb friction [N·m or N]; it falls with q.
  T torque(const T& q) const {
    return law.direction * law.link_radius * force(q) + load - law.viscous * (q - q_before) / h;
  }
};

/// d torque / d q of a step.
inline double slopeOf(const Step<double>& step, double q) {
  const auto& law = step.law;
  const double lever = law.direction * law.link_radius;
  return -lever * lever *
             (law.stiffness * std::cosh(law.exponent * step.stretch(q)) + 2.0 * law.damping / step.h) -
         law.viscous / step.h;
}

/// Joint position from the hard stop at which the cable alone holds `load` [N·m or N].
template <class T>
T restOf(const DriveLaw<T>& law, double q_m, const T& load) {
  using std::log;
  using std::sqrt;
  const T force = -load / (law.direction * law.link_radius);
  const T x = force * law.exponent / law.stiffness;
  const T stretch = (x < T(0.0) ? -log(sqrt(x * x + 1.0) - x) : log(sqrt(x * x + 1.0) + x)) / law.exponent;
  return (law.motor_radius * q_m - stretch) / (law.direction * law.link_radius);
}

/// Root of torque(q) − friction by Newton's method; a step that increases |torque − friction| is halved.
inline double slide(const Step<double>& step, double friction) {
  constexpr int kMostSteps = 50;
  double q = restOf(step.law, step.q_m, step.load - friction);
  double rest = step.torque(q) - friction;
  for (int i = 0; i < kMostSteps && rest != 0.0; ++i) {
    double move = -rest / slopeOf(step, q);
    double next = step.torque(q + move) - friction;
    for (int half = 0; half < kMostSteps && !(std::abs(next) < std::abs(rest)); ++half) {
      move *= 0.5;
      next = step.torque(q + move) - friction;
    }
    if (!(std::abs(next) < std::abs(rest))) break;
    q += move;
    rest = next;
  }
  return q;
}

/// Joint position after a step: the old one under stiction, else the one of sliding against friction.
template <class T>
T advance(const Step<T>& step) {
  const DriveLaw<double> law = valuesOf(step.law);
  const Step<double> plain{
      law, step.q_m, step.load, step.h, valueOf(step.q_before), valueOf(step.stretch_before)};
  const double push = plain.torque(plain.q_before);
  if (std::abs(push) <= law.coulomb) return step.q_before;
  const double sign = push > 0.0 ? 1.0 : -1.0;
  const T q(slide(plain, sign * law.coulomb));
  // Implicit function theorem: one Newton step in T keeps the value and adds the derivatives.
  return q - (step.torque(q) - sign * step.law.coulomb) / slopeOf(plain, valueOf(q));
}

}  // namespace drive

/// Predicts joint position and motor torque from motor position and load: model.md (3)–(6) for one joint,
/// quasi-static (inertia times acceleration is far below friction at the speeds of such recordings):
///     delta  = r_mc q_m / N − A r_l (q − q_hs)
///     gamma  = k_e (exp(a delta) − exp(−a delta)) + 2 b_e d(delta)/dt
///     0      = A r_l gamma + tau_ext − F_cl sgn(dq/dt) − F_vl dq/dt
///     tau_m  = r_mc gamma / N + tau_cm tanh(dq_m / v_eps) + tau_vm dq_m
/// sgn(dq/dt) is set-valued and not smoothed: below F_cl the joint sticks, so that cable and friction
/// together give hysteresis without creep. Integration is implicit Euler over the recording's rows. The first
/// row is at rest without friction; this initial error vanishes at the first reversal.
template <class T>
void predict(const DriveLaw<T>& law, const DriveRecording& recording, DrivePrediction<T>& prediction) {
  const std::size_t rows = recording.size();
  prediction.q.resize(rows);
  prediction.tau_m.resize(rows);
  T q(0.0), stretch(0.0);
  for (std::size_t k = 0; k < rows; ++k) {
    const double h = k > 0 ? recording.t[k] - recording.t[k - 1] : 1.0;
    const drive::Step<T> step{law, recording.q_m[k], recording.tau_ext[k], h, q, stretch};
    q = k > 0 ? drive::advance(step) : drive::restOf(law, recording.q_m[k], T(recording.tau_ext[k]));
    const T now = step.stretch(q);
    const T rate = k > 0 ? T((now - stretch) / h) : T(0.0);
    stretch = now;
    const double speed = recording.dq_m[k];
    prediction.q[k] = law.homing + q;
    prediction.tau_m[k] = law.motor_radius * drive::cableForce(law, now, rate) +
                          law.motor_coulomb * std::tanh(speed / law.motor_smoothing) +
                          law.motor_viscous * speed;
  }
}

}  // namespace capstan::identification
