#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/simulation/simulated_source.h"

namespace capstan::simulation {

/// A request for a simulated session, from the command line or the window: names and files.
struct SimulationRequest {
  std::string trajectory =
      "fls";  ///< fls, sinusoid, hold, hard-stop, a CSV with t, q1, q2, q3, or a trajectory file
  double duration = 200.0;        ///< duration of the movement [s]
  std::string truth = "default";  ///< default, matched, or a truth file
  std::uint64_t seed = 1;         ///< seed of surgeon, noise and texture
  std::filesystem::path robot;    ///< nominal robot file; empty: the left RAVEN-II
  std::filesystem::path cameras;  ///< as vision::readRig(); empty: the built-in rig
  bool cameras_fitted = true;     ///< false: motors only
  bool images = true;             ///< false: tip positions instead of images
  bool registered = true;         ///< false: the user registers the cameras
  bool distractors = false;       ///< objects of nearly the marker's colour
  bool uneven_light = false;      ///< one side of the scene has less light

  bool operator==(const SimulationRequest&) const = default;
};

/// Reads the files of `request` and returns the options of the simulation. Throws base::InputError for a name
/// that is neither known nor a file, and for an unusable file.
SimulatedOptions optionsOf(const SimulationRequest& request);

}  // namespace capstan::simulation
