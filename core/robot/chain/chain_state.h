#pragma once

#include "core/robot/chain/chain_model.h"

/// States of a chain: initial states, and relations between joints, cables and motors.
namespace capstan::robot {

/// State at q and dq. Compliant motors of rigid drives are at the positions for cables without stretch.
ChainState<double> stateAt(const ChainModel& model, const JointVector& q, const JointVector& dq);

/// Moves the compliant motors of `state` by the stretch of their cables in slow motion, compliance times F,
/// where
///     F lever = gain τ − friction(q̇_m) − I_m q̈_m,   q̈_m = q̈ link_radius / lever
/// with q̈ of the same chain with rigid cables. The oscillation of the motor is neglected.
void windUp(const ChainModel& model, const ChainInput& input, ChainState<double>& state);

/// Stretch of cable i (from 0) with its motor at q_m [rad] and the joints at q, without encoder slip and
/// drift of the zero [m].
double stretchAt(const ChainModel& model, int i, double q_m, const JointVector& q);

/// Joint positions q [rad or m] of motors at q_m with rigid cables, with the radii, the coupling and the
/// initial zero of the model.
JointVector jointsFromMotors(const ChainModel& model, const JointVector& q_m);

}  // namespace capstan::robot
