#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "core/simulation/simulation_request.h"

namespace capstan::cli {

/// Declares what `simulate` and `track --simulate` ask of a simulation on `command`, in one help group.
void addSimulationOptions(CLI::App& command, simulation::SimulationRequest& request);
/// Whether the user gave any of them.
bool simulationAsked(const CLI::App& command);

/// The source. Throws base::InputError.
std::unique_ptr<simulation::SimulatedSource> makeSimulation(const simulation::SimulationRequest& request);

}  // namespace capstan::cli
