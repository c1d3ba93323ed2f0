#include "app/cli/simulation_arguments.h"
#include "core/vision/rig_file.h"

#include <algorithm>

namespace capstan::cli {
namespace {

constexpr const char* kGroup = "Simulation";

}  // namespace

void addSimulationOptions(CLI::App& command, simulation::SimulationRequest& request) {
  const auto grouped = [](CLI::Option* option) { return option->group(kGroup); };
  grouped(command.add_option("--duration", request.duration, "duration of the movement [s]"))
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  grouped(command.add_option("--trajectory", request.trajectory,
                             "fls (block transfer), sinusoid, hold, hard-stop (rests there), a trajectory "
                             "file (.yaml), or a CSV with "
                             "t, q1, q2, q3"))
      ->capture_default_str();
  grouped(command.add_option(
              "--truth", request.truth,
              "true parameters of the robot: default, matched (as in the robot file), or a truth file"))
      ->capture_default_str();
  grouped(command.add_option("--seed", request.seed,
                             "random seed of the surgeon's motion, sensor noise and image texture"))
      ->capture_default_str();
  grouped(command.add_option("--cameras", request.cameras,
                             "calibration of the cameras: " + vision::rigFileKinds()));
  grouped(command.add_flag_callback(
      "--no-images", [&request] { request.images = false; },
      "simulate tip positions instead of images, with the truth file's pixel_sigma"));
  grouped(command.add_flag_callback(
      "--no-cameras", [&request] { request.cameras_fitted = false; },
      "simulate motors only, without cameras"));
  grouped(
      command.add_flag("--distractors", request.distractors, "add objects of nearly the marker's colour"));
  grouped(command.add_flag("--uneven-light", request.uneven_light, "light one side of the scene less"));
}

bool simulationAsked(const CLI::App& command, const std::string& apart) {
  const auto options = command.get_options([&](const CLI::Option* option) {
    return option->get_group() == kGroup && option->get_name() != apart;
  });
  return std::any_of(options.begin(), options.end(),
                     [](const CLI::Option* option) { return option->count() > 0; });
}

std::unique_ptr<simulation::SimulatedSource> makeSimulation(const simulation::SimulationRequest& request) {
  return std::make_unique<simulation::SimulatedSource>(simulation::optionsOf(request));
}

}  // namespace capstan::cli
