#include "core/experiments/trial_setup.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/results_json.h"
#include "core/identification/parameters.h"
#include "core/recording/table_source.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/options.h"
#include "core/vision/camera.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Does `work`. An error without a file, or of a missing file, gets the line of `key` with `value` in the
/// specification; `trial`, if not empty, is the name of the trial.
template <class Work>
auto blaming(const Specification& specification, const std::string& trial, const std::string& key,
             const std::string& value, Work&& work) {
  try {
    return work();
  } catch (const base::InputError& error) {
    const base::InputFault& fault = error.fault();
    std::error_code ignored;
    if (specification.file.empty() || (!fault.file.empty() && fs::exists(fault.file, ignored))) throw;
    const std::string reason =
        fault.file.empty() ? fault.reason : fmt::format("names {}, which does not exist", fault.file);
    throw base::InputError({specification.file.string(), specification.lineOf(trial, key),
                            trial.empty() ? key : fmt::format("trial {}: {}", trial, key), value, reason,
                            fault.file.empty() && !fault.remedy.empty()
                                ? fault.remedy
                                : "Give a path relative to the specification's folder, or an absolute one"});
  }
}

robot::Description nominalOf(const Specification& specification) {
  if (specification.nominal.empty()) return robot::defaultDescription();
  return blaming(specification, {}, "nominal", specification.nominal,
                 [&] { return robot::readDescription(specification.resolved(specification.nominal)); });
}

simulation::SimulatedOptions simulationOf(const Specification& specification, const TrialSpec& trial,
                                          bool images) {
  simulation::SimulationRequest request;
  request.trajectory = specification.resolved(trial.trajectory);
  request.duration = trial.duration;
  request.truth = specification.resolved(specification.truth);
  request.seed = trial.seed;
  request.robot = specification.resolved(specification.nominal);
  request.images = images;
  const auto make = [&] { return simulation::optionsOf(request); };
  simulation::SimulationRequest without = request;  // its truth alone
  without.trajectory = "hold";
  without.images = false;
  blaming(specification, {}, "truth", specification.truth, [&] { return simulation::optionsOf(without); });
  return blaming(specification, trial.name, "trajectory", trial.trajectory, make);
}

/// Name and size of a file.
json stateOf(const std::string& file) {
  std::error_code fault;
  const auto size = fs::file_size(file, fault);
  if (fault)
    throw base::InputError({file, 0, {}, {}, "cannot be read", "Check the path and its permissions"});
  return {{"file", fs::path(file).filename().string()}, {"bytes", size}};
}

/// Text of the CSV that a trajectory replays, for the fingerprint of the trial.
std::string replayedText(const simulation::TrajectorySpec& trajectory) {
  return trajectory.kind == simulation::TrajectoryKind::kRecorded
             ? base::readTextFile(trajectory.recorded.file)
             : std::string();
}

}  // namespace

robot::Description withIdentified(const robot::Description& robot,
                                  const IdentificationResult& identification) {
  std::string names;
  for (const IdentifiedParameter& parameter : identification.parameters)
    if (identification.chosen(parameter).seen) names += (names.empty() ? "" : ",") + parameter.name;
  if (names.empty()) return robot;
  const identification::ParameterSet set(robot, names);
  identification::ParameterSet::Logs logs = identification::ParameterSet::Logs::Zero(set.size());
  for (const IdentifiedParameter& parameter : identification.parameters)
    for (int i = 0; i < set.size(); ++i)
      if (set[i].name() == parameter.name)
        logs(i) = std::log(identification.chosen(parameter).value / set[i].nominal);
  return set.robot(logs);
}

RobotBelief beliefOf(const Specification& specification, const std::vector<IdentificationResult>& found) {
  if (specification.robotIsFile()) {
    const std::string& file = specification.robot.front();
    const auto robot = blaming(specification, {}, "robot", file,
                               [&] { return robot::readDescription(specification.resolved(file)); });
    return [robot](const robot::Description&) { return robot; };
  }
  return [found](const robot::Description& nominal) {
    robot::Description robot = nominal;
    for (const IdentificationResult& one : found) robot = withIdentified(robot, one);
    return robot;
  };
}

double TrialSetup::weight() const { return recording.empty() ? spec.duration : 200.0; }

void TrialSetup::addChecksum() {
  if (!recording.empty()) fingerprint["source"]["checksum"] = base::checksumOfFile(recording);
}

TrialSetup setUpTrial(const Specification& specification, const TrialSpec& trial, const RobotBelief& belief,
                      bool images, const std::string& software) {
  TrialSetup setup;
  setup.spec = trial;
  setup.belief = belief;
  setup.table_robot = nominalOf(specification);
  if (!specification.tracking.empty()) {
    setup.inputs.tracking = blaming(specification, {}, "tracking", specification.tracking, [&] {
      return base::writeYaml(tracking::readTrackingOptions(specification.resolved(specification.tracking)));
    });
  }
  json state;
  if (trial.recording.empty()) {
    setup.simulated = simulationOf(specification, trial, images);
    setup.inputs.truth = simulation::formatTruth(setup.simulated->truth);
    setup.inputs.trajectory = base::writeYaml(setup.simulated->trajectory);
    state = {{"images", images}, {"replayed", replayedText(setup.simulated->trajectory)}};
    if (setup.simulated->rig) state["rig"] = vision::formatStereoRig(*setup.simulated->rig);
  } else {
    setup.recording = specification.resolved(trial.recording);
    state = blaming(specification, trial.name, "recording", trial.recording,
                    [&] { return stateOf(setup.recording); });
    setup.read_as = blaming(specification, trial.name, "read_as", trial.read_as,
                            [&] { return recording::parseReadAs(trial.read_as, "read_as"); });
    if (!trial.read_as.empty()) state["read_as"] = trial.read_as;
    setup.inputs.recording =
        fmt::format("{}, {} bytes", state["file"].get<std::string>(), state["bytes"].get<std::uint64_t>());
  }
  setup.fingerprint = {{"format", 3},
                       {"software", software},
                       {"name", trial.name},
                       {"seed", trial.seed},
                       {"occlusion", {trial.occlusion.percentage, trial.occlusion.interval}},
                       {"nominal", robot::formatDescription(setup.table_robot)},
                       {"robot", robot::formatDescription(belief(setup.table_robot))},
                       {"truth", setup.inputs.truth},
                       {"trajectory", setup.inputs.trajectory},
                       {"tracking", setup.inputs.tracking},
                       {"source", state}};
  return setup;
}

TrialSource::TrialSource(const TrialSetup& setup) : inputs_(setup.inputs) {
  // The checksum comes before the recording is opened: closing a file removes SQLite's locks on it.
  if (!setup.recording.empty()) inputs_.recording += ", checksum " + base::checksumOfFile(setup.recording);
  if (setup.simulated)
    source_ = std::make_unique<simulation::SimulatedSource>(*setup.simulated);
  else
    source_ = recording::openRecording(setup.recording, setup.table_robot, setup.read_as);
  info_ = source_->info();
  nominal_ = info_.robot;
  info_.robot = setup.belief(nominal_);
  if (!inputs_.tracking.empty()) info_.tracking = inputs_.tracking;
  inputs_.nominal = robot::formatDescription(nominal_);
  inputs_.robot = robot::formatDescription(info_.robot);
  if (inputs_.truth.empty()) inputs_.truth = info_.truth;
  if (inputs_.tracking.empty()) inputs_.tracking = info_.tracking;
  const OcclusionSpec& occlusion = setup.spec.occlusion;
  occluded_.emplace(*source_, live::OcclusionSchedule{.percentage = occlusion.percentage,
                                                      .interval = occlusion.interval,
                                                      .start = info_.begin});
}

}  // namespace capstan::experiments
