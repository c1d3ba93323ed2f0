#pragma once

/// Numbers of a driven chain, for any scalar: double, or SIMD lanes with one robot per lane. This file uses
/// neither Eigen nor the standard library, so that kernels for other instruction sets may include it.
namespace capstan::robot {

inline constexpr int kChainJoints = 7;  ///< largest number of joints of a chain

/// Laws beyond the nominal model that are in use at a joint; bits of ChainShape::laws. A law in use has no
/// effect while its numbers are neutral, except kLawCompliance.
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
  kLawExponential = 1u << 13,  ///< stretch is so large that sinh y differs from y + y³ / 6
  kLawCompliance = 1u << 12,   ///< in a rigid drive, motor and joint can move relative to each other
  kLawZeroDrift = 1u << 15,
};

/// Numbers of motor, cable and friction of one joint. A neutral value of a number switches its effect off.
template <class S>
struct JointNumbers {
  S lever;               ///< r_mc / N [m/rad]
  S inverse_gear;        ///< 1 / N: angle of the capstan per angle of the motor
  S eccentric_sine;      ///< eccentricity e_s [m], neutral 0
  S eccentric_cosine;    ///< eccentricity e_c [m], neutral 0
  S slip;                ///< lost counts as an angle of the motor [rad], neutral 0
  S slip_time;           ///< time of the slip [s]
  S link_radius;         ///< r_l [m/rad or m/m]
  S homing;              ///< q_hs [rad or m]
  S zero_drift;          ///< final drift of the cable's zero [rad or m], neutral 0
  S zero_drift_rate;     ///< 1 / time constant of the drift [1/s]
  S zero_drift_begun;    ///< share of the drift at the begin of the recording, neutral 0
  S stiffness;           ///< k_e [N]
  S exponent;            ///< a [1/m]
  S damping;             ///< b_e [N·s/m]
  S stiffening;          ///< cubic coefficient c [1/m²], neutral 0
  S position_stiffness;  ///< share s of positionShare(), neutral 0
  S length_share;        ///< form of the position's effect: 1 free length, 0 stiffness, see positionShare()
  S play;                ///< half-width of the play [m], neutral 0
  S play_damping;        ///< action of the damper at the play: 0 pressing, 1 while closed, 2 always
  S pretension;          ///< stretch at which one cable sags [m], neutral kSound
  S hysteresis_force;    ///< largest force of the hysteresis [N], neutral 0
  S inverse_yield;       ///< 1 / yield stretch of the hysteresis [1/m]
  S creep_share;         ///< final creep over elastic stretch, neutral 0
  S creep_rate;          ///< 1 / time constant of the creep [1/s]
  S creep_begun;         ///< share of the final creep at the start of a simulation, neutral 0
  S coulomb;             ///< F_cl [N·m or N]
  S viscous;             ///< F_vl [N·m·s or N·s/m]
  S inverse_smoothing;   ///< 1 / v_eps
  S stribeck_excess;     ///< share of Coulomb friction, neutral 0
  S inverse_stribeck;    ///< 1 / Stribeck speed
  S asymmetry;           ///< share of Coulomb friction, neutral 0
  S viscous_asymmetry;   ///< share of viscous friction, neutral 0
  S load_friction;       ///< share of the driving torque, neutral 0
  S wave_sine;           ///< share of Coulomb friction, neutral 0
  S wave_cosine;         ///< share of Coulomb friction, neutral 0
  S wave_number;         ///< 2π / period [1/rad or 1/m]
  S armature;            ///< inertia added to the diagonal of the mass matrix, neutral 0
  S load_gain;           ///< factor of the load: 1, or −1 to reverse its sign
  S load_sign;           ///< 0: loads as measured; 1: with the signs of ChainInput::signed_load
  S gain;                ///< actual over commanded torque, neutral 1
  S offset;              ///< constant torque or force at the joint [N·m or N], neutral 0
  S motor_inertia;       ///< I_m [kg·m²]
  S motor_coulomb;       ///< tau_cm [N·m]
  S motor_viscous;       ///< tau_vm
  S inverse_motor_smoothing;
  S compliance;  ///< compliance of a rigid drive [m/N]; used only with kLawCompliance, and then above 0
};
inline constexpr double kSound = 1e3;  ///< pretension stretch of a pair that never sags [m]

/// Ten inertial parameters of a rigid body about the origin of its frame; its dynamics is linear in them.
template <class S>
struct LinkNumbers {
  S mass;        ///< [kg]
  S moment[3];   ///< mass times centre of mass [kg·m]
  S inertia[6];  ///< inertia xx yy zz xy xz yz [kg·m²]
};

template <class S>
struct ChainNumbers {
  JointNumbers<S> joints[kChainJoints];
  LinkNumbers<S> links[kChainJoints];
  S coupling[kChainJoints][kChainJoints];  ///< A
  S gravity[3];                            ///< gravity in frame 0 [m/s²]
};

/// Properties that all lanes share.
struct ChainShape {
  int joints = 0;
  bool rigid = false;  ///< whether motor torques drive the joints; else motor positions drive the cables
  unsigned laws[kChainJoints] = {};  ///< ChainLaw bits
  bool revolute[kChainJoints] = {};
  double sin_alpha[kChainJoints] = {}, cos_alpha[kChainJoints] = {};
  double a[kChainJoints] = {}, d[kChainJoints] = {}, theta[kChainJoints] = {};  ///< DH row
  double middle[kChainJoints] = {},
         inverse_half_range[kChainJoints] = {};  ///< middle and inverse half range of the joint limits
  double farthest[kChainJoints] = {};            ///< limit of |q − middle| in a simulation [rad or m]
  double fastest[kChainJoints] = {};             ///< limit of |dq| in a simulation [rad/s or m/s]
};

template <class S>
struct ChainState {
  S q[kChainJoints], dq[kChainJoints];
  S hysteresis[kChainJoints];                       ///< Bouc–Wen state z [m]
  S creep[kChainJoints];                            ///< creep elongation [m]
  S motor[kChainJoints], motor_rate[kChainJoints];  ///< motors of compliant rigid drives [rad, rad/s]
};

/// Input of the chain from one row to the next: one number per joint, the same for all lanes.
struct ChainInput {
  double t = 0.0, dt = 0.0;
  double motor[kChainJoints] = {}, motor_end[kChainJoints] = {};   ///< q_m at both ends [rad], linear between
  double torque[kChainJoints] = {};                                ///< constant torque of rigid drives [N·m]
  double load[kChainJoints] = {}, signed_load[kChainJoints] = {};  ///< constant tau_ext [N·m or N]
};

}  // namespace capstan::robot
