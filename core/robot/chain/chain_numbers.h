#pragma once

/// The numbers of a driven chain, for any scalar: double, or lanes of a SIMD register with another robot in
/// each. No Eigen and no standard library here, so that kernels compiled for other instruction sets may
/// include it.
namespace capstan::robot {

inline constexpr int kChainJoints = 7;  ///< most joints of a chain

/// Laws beyond the nominal model that take part at a joint; bits of ChainShape::laws. A law that takes part
/// changes nothing while its numbers are neutral, except kCompliance.
enum ChainLaw : unsigned {
  kLawEccentricity = 1u << 0,
  kLawSlip = 1u << 1,
  kLawStiffening = 1u << 2,
  kLawPositionStiffness = 1u << 3,
  kLawPlay = 1u << 4,
  kLawSlack = 1u << 5,
  kLawHysteresis = 1u << 6,
  kLawCreep = 1u << 7,
  kLawStribeck = 1u << 8,
  kLawAsymmetry = 1u << 9,
  kLawLoadFriction = 1u << 10,
  kLawWave = 1u << 11,
  kLawAsymmetricViscosity = 1u << 14,
  kLawExponential = 1u << 13,  ///< cables stretch so far that sinh y is not y + y³ / 6
  kLawCompliance = 1u << 12,   ///< of a rigid drive: motor and joint move apart
  kLawZeroDrift = 1u << 15,
};

/// Motor, cable and friction of one joint. Neutral where a number reports it.
template <class S>
struct JointNumbers {
  S lever;               ///< r_mc / N [m/rad]
  S inverse_gear;        ///< 1 / N: angle of the capstan by that of the motor
  S eccentric_sine;      ///< [m], neutral 0
  S eccentric_cosine;    ///< [m], neutral 0
  S slip;                ///< counts lost, as an angle of the motor [rad], neutral 0
  S slip_time;           ///< [s]
  S link_radius;         ///< r_l [m/rad or m/m]
  S homing;              ///< q_hs [rad or m]
  S zero_drift;          ///< of q_hs in the long run [rad or m], neutral 0
  S zero_drift_rate;     ///< 1 / time constant [1/s]
  S stiffness;           ///< k_e [N]
  S exponent;            ///< a [1/m]
  S damping;             ///< b_e [N·s/m]
  S stiffening;          ///< [1/m²], neutral 0
  S position_stiffness;  ///< share at the ends of the range, neutral 0
  S play;                ///< half-width [m], neutral 0
  S pretension;          ///< stretch at which one cable sags [m], neutral kSound
  S hysteresis_force;    ///< [N], neutral 0
  S inverse_yield;       ///< [1/m]
  S creep_share;         ///< neutral 0
  S creep_rate;          ///< 1 / time constant [1/s]
  S creep_begun;         ///< share of its balance that the creep has where a simulation starts, neutral 0
  S coulomb;             ///< F_cl [N·m or N]
  S viscous;             ///< F_vl
  S inverse_smoothing;   ///< 1 / v_eps
  S stribeck_excess;     ///< share of Coulomb, neutral 0
  S inverse_stribeck;    ///< 1 / Stribeck speed
  S asymmetry;           ///< share of Coulomb, neutral 0
  S viscous_asymmetry;   ///< share of the viscous, neutral 0
  S load_friction;       ///< share of the driving torque, neutral 0
  S wave_sine;           ///< share of Coulomb, neutral 0
  S wave_cosine;         ///< share of Coulomb, neutral 0
  S wave_number;         ///< 2π / period [1/rad or 1/m]
  S armature;            ///< added to the diagonal of the mass matrix, neutral 0
  S load_gain;           ///< 1, or −1: given signs are reversed
  S load_sign;           ///< 0: loads as measured; 1: with the signs of ChainInput::signed_load
  S gain;                ///< torque that arrives over commanded torque, neutral 1
  S offset;              ///< torque or force at the joint that is always there, neutral 0
  S motor_inertia;       ///< I_m [kg·m²]
  S motor_coulomb;       ///< tau_cm [N·m]
  S motor_viscous;       ///< tau_vm
  S inverse_motor_smoothing;
  S compliance;  ///< of a rigid drive [m/N]; looked at with kLawCompliance alone, and then above 0
};
inline constexpr double kSound = 1e3;  ///< pretension stretch of a pair that never sags [m]

/// Rigid body by the ten numbers that its dynamics is linear in, about the origin of its frame, in its axes.
template <class S>
struct LinkNumbers {
  S mass;        ///< [kg]
  S moment[3];   ///< mass times centre of mass [kg·m]
  S inertia[6];  ///< xx yy zz xy xz yz [kg·m²]
};

template <class S>
struct ChainNumbers {
  JointNumbers<S> joints[kChainJoints];
  LinkNumbers<S> links[kChainJoints];
  S coupling[kChainJoints][kChainJoints];  ///< A
  S gravity[3];                            ///< frame 0 [m/s²]
};

/// What all lanes have in common.
struct ChainShape {
  int joints = 0;
  bool rigid = false;                ///< motor torque drives the joints; else motor positions the cables
  unsigned laws[kChainJoints] = {};  ///< ChainLaw bits
  bool revolute[kChainJoints] = {};
  double sin_alpha[kChainJoints] = {}, cos_alpha[kChainJoints] = {};
  double a[kChainJoints] = {}, d[kChainJoints] = {}, theta[kChainJoints] = {};  ///< DH row
  double middle[kChainJoints] = {}, inverse_half_range[kChainJoints] = {};      ///< of the joint limits
  double farthest[kChainJoints] = {};  ///< |q − middle| is cut off there [rad or m]
  double fastest[kChainJoints] = {};   ///< |dq| is cut off there
};

template <class S>
struct ChainState {
  S q[kChainJoints], dq[kChainJoints];
  S hysteresis[kChainJoints];                       ///< Bouc–Wen z [m]
  S creep[kChainJoints];                            ///< elongation [m]
  S motor[kChainJoints], motor_rate[kChainJoints];  ///< of compliant rigid drives [rad, rad/s]
};

/// What drives the chain from one row to the next: arrays by joint, the same for all lanes.
struct ChainInput {
  double t = 0.0, dt = 0.0;
  double motor[kChainJoints] = {}, motor_end[kChainJoints] = {};   ///< q_m at both ends [rad], linear between
  double torque[kChainJoints] = {};                                ///< of rigid drives, held
  double load[kChainJoints] = {}, signed_load[kChainJoints] = {};  ///< tau_ext, held
};

}  // namespace capstan::robot
