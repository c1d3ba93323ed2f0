#pragma once

#include <cmath>

#include "core/robot/chain/chain_numbers.h"

/// Rigid-body dynamics of a chain, for any scalar: outward and inward Newton–Euler recursion over a modified
/// Denavit–Hartenberg table (Luh, Walker, Paul 1980, in the form of Craig, Introduction to Robotics, 3rd ed.,
/// 6.45–6.53, about link origins). The mass matrix is computed column by column.
namespace capstan::robot {

#define CAPSTAN_CHAIN_INLINE [[gnu::always_inline]] inline

template <class S>
struct Triple {
  S x, y, z;
};
template <class S>
CAPSTAN_CHAIN_INLINE Triple<S> operator+(const Triple<S>& a, const Triple<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
CAPSTAN_CHAIN_INLINE Triple<S> cross(const Triple<S>& a, const Triple<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class S>
CAPSTAN_CHAIN_INLINE Triple<S> scaled(const S& k, const Triple<S>& a) {
  return {k * a.x, k * a.y, k * a.z};
}

/// Pose of link i in the previous frame: origin, and sines and cosines of RotX(alpha) RotZ(theta).
template <class S>
struct LinkPose {
  S sine, cosine;
  Triple<S> origin;
  double sin_alpha, cos_alpha;

  CAPSTAN_CHAIN_INLINE Triple<S> out(
      const Triple<S>& v) const {  ///< rotates v from the previous frame to the link's
    const S y = cos_alpha * v.y + sin_alpha * v.z;
    return {cosine * v.x + sine * y, cosine * y - sine * v.x, cos_alpha * v.z - sin_alpha * v.y};
  }
  CAPSTAN_CHAIN_INLINE Triple<S> back(
      const Triple<S>& v) const {  ///< rotates v from the link's frame to the previous one
    const S y = sine * v.x + cosine * v.y;
    return {cosine * v.x - sine * v.y, cos_alpha * y - sin_alpha * v.z, sin_alpha * y + cos_alpha * v.z};
  }
};

template <class S>
CAPSTAN_CHAIN_INLINE LinkPose<S> placeOf(const ChainShape& shape, int i, const S& q) {
  using std::cos, std::sin;
  LinkPose<S> place;
  place.sin_alpha = shape.sin_alpha[i];
  place.cos_alpha = shape.cos_alpha[i];
  const S zero = q - q;
  const S theta = shape.revolute[i] ? q + shape.theta[i] : zero + shape.theta[i];
  const S d = shape.revolute[i] ? zero + shape.d[i] : q + shape.d[i];
  place.sine = sin(theta);
  place.cosine = cos(theta);
  place.origin = {zero + shape.a[i], -place.sin_alpha * d, place.cos_alpha * d};
  return place;
}

/// Motion of a link's frame: angular velocity, angular and linear acceleration.
template <class S>
struct LinkMotion {
  Triple<S> omega, alpha, acceleration;
};
template <class S>
struct Wrench {
  Triple<S> force, moment;
};

template <class S>
CAPSTAN_CHAIN_INLINE Triple<S> inertiaTimes(const LinkNumbers<S>& link, const Triple<S>& v) {
  const S(&i)[6] = link.inertia;
  return {i[0] * v.x + i[3] * v.y + i[4] * v.z, i[3] * v.x + i[1] * v.y + i[5] * v.z,
          i[4] * v.x + i[5] * v.y + i[2] * v.z};
}

/// Wrench that a link's motion requires: force m a + dω × mc + ω × (ω × mc), and moment about the link's
/// origin I dω + ω × I ω + mc × a.
template <class S>
CAPSTAN_CHAIN_INLINE Wrench<S> wrenchOf(const LinkNumbers<S>& link, const LinkMotion<S>& m) {
  const Triple<S> moment = {link.moment[0], link.moment[1], link.moment[2]};
  return {scaled(link.mass, m.acceleration) + cross(m.alpha, moment) + cross(m.omega, cross(m.omega, moment)),
          inertiaTimes(link, m.alpha) + cross(m.omega, inertiaTimes(link, m.omega)) +
              cross(moment, m.acceleration)};
}

/// Wrench that the motion of a link requires when its velocity is zero.
template <class S>
CAPSTAN_CHAIN_INLINE Wrench<S> startingWrench(const LinkNumbers<S>& link, const Triple<S>& alpha,
                                              const Triple<S>& acceleration) {
  const Triple<S> moment = {link.moment[0], link.moment[1], link.moment[2]};
  return {scaled(link.mass, acceleration) + cross(alpha, moment),
          inertiaTimes(link, alpha) + cross(moment, acceleration)};
}

template <class S>
CAPSTAN_CHAIN_INLINE void carryBack(const LinkPose<S>& place, const Wrench<S>& from, Wrench<S>& to) {
  const Triple<S> force = place.back(from.force);
  to.moment = to.moment + place.back(from.moment) + cross(place.origin, force);
  to.force = to.force + force;
}

/// Mass matrix M(q), full and symmetric, and bias C(q, dq) dq + G(q).
template <class S>
struct ChainBodies {
  S mass[kChainJoints][kChainJoints];
  S bias[kChainJoints];
};

template <class S>
CAPSTAN_CHAIN_INLINE void biasOf(const ChainShape& shape, const ChainNumbers<S>& p,
                                 const LinkPose<S> (&places)[kChainJoints], const S* dq,
                                 ChainBodies<S>& bodies) {
  const S zero = dq[0] - dq[0];
  Triple<S> omega = {zero, zero, zero}, alpha = omega;
  Triple<S> acceleration = {-p.gravity[0], -p.gravity[1], -p.gravity[2]};
  Wrench<S> wrenches[kChainJoints];
  for (int i = 0; i < shape.joints; ++i) {
    const LinkPose<S>& place = places[i];
    acceleration =
        place.out(acceleration + cross(alpha, place.origin) + cross(omega, cross(omega, place.origin)));
    omega = place.out(omega);
    alpha = place.out(alpha);
    const Triple<S> spin = {zero, zero, dq[i]};
    if (shape.revolute[i]) {
      alpha = alpha + cross(omega, spin);
      omega = omega + spin;
    } else {
      const Triple<S> coriolis = cross(omega, spin);
      acceleration = acceleration + coriolis + coriolis;
    }
    wrenches[i] = wrenchOf<S>(p.links[i], {omega, alpha, acceleration});
  }
  for (int i = shape.joints - 1; i >= 0; --i) {
    bodies.bias[i] = shape.revolute[i] ? wrenches[i].moment.z : wrenches[i].force.z;
    if (i > 0) carryBack(places[i], wrenches[i], wrenches[i - 1]);
  }
}

template <class S>
CAPSTAN_CHAIN_INLINE void massOf(const ChainShape& shape, const ChainNumbers<S>& p,
                                 const LinkPose<S> (&places)[kChainJoints], const S& zero,
                                 ChainBodies<S>& bodies) {
  for (int j = 0; j < shape.joints; ++j) {  // joint j alone accelerates by 1
    Wrench<S> wrenches[kChainJoints];
    Triple<S> alpha = {zero, zero, zero}, acceleration = alpha;
    (shape.revolute[j] ? alpha.z : acceleration.z) = zero + 1.0;
    for (int i = j; i < shape.joints; ++i) {
      if (i > j) {
        acceleration = places[i].out(acceleration + cross(alpha, places[i].origin));
        alpha = places[i].out(alpha);
      }
      wrenches[i] = startingWrench<S>(p.links[i], alpha, acceleration);
    }
    for (int i = shape.joints - 1; i > j; --i) carryBack(places[i], wrenches[i], wrenches[i - 1]);
    for (int i = j; i >= 0; --i) {
      bodies.mass[i][j] = bodies.mass[j][i] = shape.revolute[i] ? wrenches[i].moment.z : wrenches[i].force.z;
      if (i == 0) break;
      wrenches[i - 1] = {{zero, zero, zero}, {zero, zero, zero}};
      carryBack(places[i], wrenches[i], wrenches[i - 1]);
    }
  }
}

template <class S>
CAPSTAN_CHAIN_INLINE void chainBodies(const ChainShape& shape, const ChainNumbers<S>& p, const S* q,
                                      const S* dq, ChainBodies<S>& bodies) {
  LinkPose<S> places[kChainJoints];
  for (int i = 0; i < shape.joints; ++i) places[i] = placeOf<S>(shape, i, q[i]);
  biasOf<S>(shape, p, places, dq, bodies);
  massOf<S>(shape, p, places, q[0] - q[0], bodies);
}

/// Computes the square-root-free Cholesky factors L D Lᵀ in place: L below the diagonal, 1 / D on it.
template <class S>
CAPSTAN_CHAIN_INLINE void factorise(int n, S (&m)[kChainJoints][kChainJoints]) {
  for (int j = 0; j < n; ++j) {
    S pivot = m[j][j];
    S scaled_row[kChainJoints];
    for (int k = 0; k < j; ++k) {
      scaled_row[k] = m[j][k] * m[k][j];  // L_jk D_k, kept above the diagonal
      pivot = pivot - m[j][k] * scaled_row[k];
    }
    for (int i = j + 1; i < n; ++i) {
      S sum = m[i][j];
      for (int k = 0; k < j; ++k) sum = sum - m[i][k] * scaled_row[k];
      m[i][j] = sum;
    }
    const S inverse = 1.0 / pivot;
    for (int i = j + 1; i < n; ++i) m[i][j] = m[i][j] * inverse;
    for (int i = j + 1; i < n; ++i) m[j][i] = pivot;
    m[j][j] = inverse;
  }
}

/// Solves L D Lᵀ x = b in place.
template <class S>
CAPSTAN_CHAIN_INLINE void solve(int n, const S (&m)[kChainJoints][kChainJoints], S* b) {
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < i; ++k) b[i] = b[i] - m[i][k] * b[k];
  for (int i = 0; i < n; ++i) b[i] = b[i] * m[i][i];
  for (int i = n - 2; i >= 0; --i)
    for (int k = i + 1; k < n; ++k) b[i] = b[i] - m[k][i] * b[k];
}

}  // namespace capstan::robot
