#include "app/cli/simulation_arguments.h"

#include <algorithm>
#include <filesystem>

#include "app/cli/console.h"
#include "app/cli/recordings.h"
#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/vision/camera.h"

namespace capstan::cli {
namespace {

constexpr const char* kGroup = "Simulation";
constexpr int kDistractors = 6;
constexpr double kUnevenness = 0.7;

simulation::TrajectorySpec trajectoryOf(const SimulationArguments& arguments) {
  using Kind = simulation::TrajectoryKind;
  simulation::TrajectorySpec spec;
  spec.duration = arguments.duration;
  const std::string& name = arguments.trajectory;
  if (name == "fls") {
    spec.kind = Kind::kBlockTransfer;
  } else if (name == "sinusoid") {
    spec.kind = Kind::kSinusoid;
  } else if (name == "hold") {
    spec.kind = Kind::kHold;
  } else if (name == "hard-stop") {
    spec.kind = Kind::kHardStop;
    spec.hard_stop.rest = arguments.duration;
  } else if (std::filesystem::exists(name)) {
    spec.kind = Kind::kRecorded;
    spec.recorded.file = name;
  } else {
    refuseOption("--trajectory", name, "is neither a known movement nor a file",
                 "Give fls, sinusoid, hold, hard-stop, or a CSV with the columns t, q1, q2, q3");
  }
  return spec;
}

simulation::Truth truthOf(const SimulationArguments& arguments) {
  simulation::Truth truth;
  if (arguments.truth.empty() || arguments.truth == "default")
    truth = simulation::defaultTruth();
  else if (arguments.truth == "matched")
    truth = simulation::matchedTruth();
  else
    truth = simulation::readTruth(arguments.truth);
  if (arguments.distractors) truth.images.distractors = std::max(truth.images.distractors, kDistractors);
  if (arguments.uneven_light) truth.images.unevenness = std::max(truth.images.unevenness, kUnevenness);
  return truth;
}

vision::StereoRig rigOf(const SimulationArguments& arguments) {
  const std::filesystem::path folder = arguments.cameras;
  if (arguments.cameras.empty())
    return vision::readStereoRig(base::resource("cameras/left.yaml"), base::resource("cameras/right.yaml"));
  return vision::readStereoRig(folder / "left.yaml", folder / "right.yaml");
}

}  // namespace

void addSimulationOptions(CLI::App& command, SimulationArguments& arguments) {
  const auto grouped = [](CLI::Option* option) { return option->group(kGroup); };
  grouped(command.add_option("--duration", arguments.duration, "length of the movement [s]"))
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  grouped(command.add_option(
              "--trajectory", arguments.trajectory,
              "fls (block transfer), sinusoid, hold, hard-stop (rests there), or a CSV with t, q1, q2, q3"))
      ->capture_default_str();
  grouped(command.add_option("--truth", arguments.truth,
                             "what the robot really is: default, matched, or a truth file"));
  grouped(command.add_option("--seed", arguments.seed, "surgeon, noise and texture"))->capture_default_str();
  grouped(command.add_option("--cameras", arguments.cameras, "folder with left.yaml and right.yaml"));
  grouped(command.add_flag("!--no-images", arguments.images, "tip positions instead of pictures"));
  grouped(command.add_flag("!--no-cameras", arguments.cameras_fitted, "motors only"));
  grouped(command.add_flag("--distractors", arguments.distractors, "objects of nearly the marker's colour"));
  grouped(command.add_flag("--uneven-light", arguments.uneven_light, "one side of the scene in the dark"));
}

bool simulationAsked(const CLI::App& command) {
  const auto options =
      command.get_options([](const CLI::Option* option) { return option->get_group() == kGroup; });
  return std::any_of(options.begin(), options.end(),
                     [](const CLI::Option* option) { return option->count() > 0; });
}

std::unique_ptr<simulation::SimulatedSource> makeSimulation(const SimulationArguments& arguments) {
  simulation::SimulatedOptions options;
  options.robot = readRobot(arguments.robot);
  options.truth = truthOf(arguments);
  options.trajectory = trajectoryOf(arguments);
  options.seed = arguments.seed;
  if (arguments.cameras_fitted) options.rig = rigOf(arguments);
  options.images = arguments.images;
  return std::make_unique<simulation::SimulatedSource>(options);
}

}  // namespace capstan::cli
