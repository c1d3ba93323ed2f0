#pragma once

#include "core/robot/chain/chain_model.h"

/// Where a chain stands: states to start from, cables and motors beside joints.
namespace capstan::robot {

/// State at q and dq; compliant motors of rigid drives stand where an unstretched cable puts them.
ChainState<double> stateAt(const ChainModel& model, const JointVector& q, const JointVector& dq);

/// Moves the compliant motors of `state` on from there to where the slow motion has wound their cables up:
/// the stretch compliance F of
///     F lever = gain τ − friction(q̇_m) − I_m q̈_m,   q̈_m = q̈ link_radius / lever
/// with q̈ of the same chain on rigid cables. What is neglected is the motor's own oscillation.
void windUp(const ChainModel& model, const ChainInput& input, ChainState<double>& state);

/// Stretch of cable i (from 0) with its motor at q_m [rad] and the joints at q, a slip of the encoder and a
/// zero that has moved aside [m].
double stretchAt(const ChainModel& model, int i, double q_m, const JointVector& q);

/// q that the motors would give with rigid cables, with the model's own radii, coupling and zero at the
/// begin of the recording [rad or m].
JointVector jointsFromMotors(const ChainModel& model, const JointVector& q_m);

}  // namespace capstan::robot
