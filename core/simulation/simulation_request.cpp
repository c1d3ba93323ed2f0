#include "core/simulation/simulation_request.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "core/vision/rig_file.h"

namespace capstan::simulation {
namespace {

constexpr int kDistractors = 6;
constexpr double kUnevenness = 0.7;

TrajectorySpec trajectoryOf(const SimulationRequest& request) {
  using Kind = TrajectoryKind;
  TrajectorySpec spec;
  spec.duration = request.duration;
  const std::string& name = request.trajectory;
  if (name == "fls") {
    spec.kind = Kind::kBlockTransfer;
  } else if (name == "sinusoid") {
    spec.kind = Kind::kSinusoid;
  } else if (name == "hold") {
    spec.kind = Kind::kHold;
  } else if (name == "hard-stop") {
    spec.kind = Kind::kHardStop;
    spec.hard_stop.rest = request.duration;
  } else if (const auto suffix = std::filesystem::path(name).extension();
             suffix == ".yaml" || suffix == ".yml") {
    spec = base::readYamlFile<TrajectorySpec>(name);
    spec.duration = request.duration;
  } else if (std::filesystem::exists(name)) {
    spec.kind = Kind::kRecorded;
    spec.recorded.file = name;
  } else {
    throw base::InputError(
        {{},
         0,
         "trajectory",
         name,
         "is neither a known movement nor a file",
         "Give fls, sinusoid, hold, hard-stop, a CSV with the columns t, q1, q2, q3, or a trajectory "
         "file (.yaml)"});
  }
  return spec;
}

Truth truthOf(const SimulationRequest& request) {
  if (request.truth != "default" && request.truth != "matched" && !std::filesystem::exists(request.truth))
    throw base::InputError({{},
                            0,
                            "truth",
                            request.truth,
                            "is neither a known truth nor a file",
                            "Give default, matched, or a truth file (.yaml)"});
  Truth truth = request.truth == "default"   ? defaultTruth()
                : request.truth == "matched" ? matchedTruth()
                                             : readTruth(request.truth);
  if (request.distractors) truth.images.distractors = std::max(truth.images.distractors, kDistractors);
  if (request.uneven_light) truth.images.unevenness = std::max(truth.images.unevenness, kUnevenness);
  return truth;
}

vision::StereoRig rigOf(const std::filesystem::path& cameras) {
  if (cameras.empty())
    return vision::readStereoRig(base::resource("cameras/left.yaml"), base::resource("cameras/right.yaml"));
  return vision::readRig(cameras);
}

}  // namespace

SimulatedOptions optionsOf(const SimulationRequest& request) {
  SimulatedOptions options;
  options.robot = robot::readDescriptionOrDefault(request.robot);
  options.truth = truthOf(request);
  options.trajectory = trajectoryOf(request);
  options.seed = request.seed;
  if (request.cameras_fitted) options.rig = rigOf(request.cameras);
  options.images = request.images;
  options.registered = request.registered;
  return options;
}

}  // namespace capstan::simulation
