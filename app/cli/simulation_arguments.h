#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "core/simulation/simulated_source.h"

namespace capstan::cli {

/// What `simulate` and `track --simulate` ask of a simulation.
struct SimulationArguments {
  double duration = 200.0;         ///< [s]
  std::string trajectory = "fls";  ///< fls, sinusoid, hold, hard-stop, or a CSV of joints
  std::string truth;               ///< truth file, or "default" / "matched"
  std::uint64_t seed = 1;
  std::string robot;    ///< robot file; empty: left RAVEN-II
  std::string cameras;  ///< folder with left.yaml and right.yaml; empty: the built-in rig
  bool images = true;
  bool cameras_fitted = true;
  bool distractors = false;
  bool uneven_light = false;
};

/// Declares the options on `command`, in one help group.
void addSimulationOptions(CLI::App& command, SimulationArguments& arguments);
/// Whether the user gave any of them.
bool simulationAsked(const CLI::App& command);

/// The source. Throws base::InputError.
std::unique_ptr<simulation::SimulatedSource> makeSimulation(const SimulationArguments& arguments);

}  // namespace capstan::cli
