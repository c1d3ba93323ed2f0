#pragma once

#include <CLI/CLI.hpp>
#include <memory>

#include "core/simulation/simulation_request.h"

namespace capstan::cli {

/// Declares the options of a simulation on `command`, in one help group.
void addSimulationOptions(CLI::App& command, simulation::SimulationRequest& request);
/// Returns whether the user gave any option of the simulation.
bool simulationAsked(const CLI::App& command, const std::string& apart = {});

/// Makes the simulated source that `request` describes. Throws base::InputError.
std::unique_ptr<simulation::SimulatedSource> makeSimulation(const simulation::SimulationRequest& request);

}  // namespace capstan::cli
