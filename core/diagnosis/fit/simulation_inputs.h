#pragma once

#include "core/base/random.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/robot/chain/chain_lanes.h"

namespace capstan::diagnosis {

/// Inputs of the simulations of one recording, one column per joint, without their sensors' noise, which
/// would excite a simulation.
struct SimulationInputs {
  Columns drive;              ///< motor torques of rigid drives, or motor positions of cable drives
  Columns load, signed_load;  ///< loads as measured, and with the signs of withSigns(); empty: not measured

  /// The kernels' view of these columns and of the times `t`, valid as long as both.
  robot::ChainRows rows(const std::vector<double>& t) const;
};

SimulationInputs inputsOf(const Evidence& evidence);

/// The same with random noise of the size of the sensors' noise on loads, and on motor positions of cable
/// drives.
SimulationInputs shakenInputs(const Evidence& evidence, const SimulationInputs& inputs, base::Random& random);

/// `inputs` with random noise on the motor torques of rigid drives, of the size of their own white noise: a
/// controller that is faster than the recording commands torques that no row contains.
SimulationInputs withTorqueNoise(const Evidence& evidence, const SimulationInputs& inputs,
                                 base::Random& random);

}  // namespace capstan::diagnosis
