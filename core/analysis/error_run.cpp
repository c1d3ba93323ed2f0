#include "core/analysis/error_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/same_recording.h"
#include "core/experiments/motion_collector.h"
#include "core/experiments/trial_robots.h"
#include "core/recording/table_source.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::analysis {
namespace {

namespace fs = std::filesystem;

/// Capacity for a recording: points of 35 minutes at 1 kHz.
constexpr std::size_t kRecordingCapacity = std::size_t{1} << 21;

bool occluded(const tracking::Snapshot& s) { return tracking::markerLost(s) || tracking::cameraSilent(s); }

[[noreturn]] void refuse(const std::string& file, std::string key, std::string value, std::string reason,
                         std::string remedy) {
  throw base::InputError({file, 0, std::move(key), std::move(value), std::move(reason), std::move(remedy)});
}

/// Checksum of a recording, independent of its name, as at the end of TrialInputs::recording.
std::string motionOf(const fs::path& recording) { return "checksum " + base::checksumOfFile(recording); }

bool isFileOf(const fs::path& file, const ErrorRun& run) {
  return std::any_of(run.files.begin(), run.files.end(),
                     [&](const fs::path& other) { return base::sameRecording(file, other); });
}

/// True when `run` names its motion by the bytes of a recording, and `file` has the same bytes.
bool isMotionOf(const fs::path& file, const ErrorRun& run) {
  try {
    return run.files.empty() && run.motion.starts_with("checksum ") && motionOf(file) == run.motion;
  } catch (const base::InputError&) {
    return false;
  }
}

bool anyFileIn(const ErrorRun& a, const ErrorRun& b) {
  return std::any_of(a.files.begin(), a.files.end(),
                     [&](const fs::path& file) { return isFileOf(file, b) || isMotionOf(file, b); });
}

std::string motionOf(const experiments::TrialResult& trial) {
  const std::string& recording = trial.inputs.recording;
  if (!recording.empty()) {
    const auto at = recording.rfind(", checksum ");
    return at == std::string::npos ? std::string() : recording.substr(at + 2);  // older results have none
  }
  return fmt::format("seed {}\n{}\n{}", trial.seed, trial.inputs.truth, trial.inputs.trajectory);
}

/// Folders of results inside `folder`, as `capstan-cli experiment all` leaves them.
std::vector<std::string> resultsWithin(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code fault;
  for (const auto& entry : fs::directory_iterator(folder, fault))
    if (fs::exists(entry.path() / "results.json", fault)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Errors of the pipeline on `source` when it assumes `robot`, with the texts of `names`.
ErrorRun trackSource(tracking::Source& source, const robot::Description& robot, ErrorRun names,
                     const RunWatch& watch, base::Progress& progress) {
  tracking::SourceInfo info = source.info();
  info.robot = robot;
  watch.begin(info);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info);
  ErrorCollector collector(kRecordingCapacity);
  experiments::SessionMotion motion(kRecordingCapacity, info.reference || info.own_kinematics);
  const tracking::TrackReport report =
      tracking::trackAll(source, pipeline, &progress, info.duration,
                         [&](const tracking::Sample&, const tracking::Snapshot& snapshot) {
                           collector.take(snapshot);
                           motion.take(snapshot);
                           watch.take(snapshot);
                         });
  ErrorRun run = std::move(names);
  ErrorRun found = collector.run();
  run.errors = std::move(found.errors);
  run.camera = std::move(found.camera);
  run.moments = found.moments;
  run.trajectory = motion.trajectory();
  run.begin = report.first_t;
  run.end = report.last_t;
  run.own_kinematics = info.own_kinematics;
  run.simulated = !info.truth.empty();
  run.notices = info.notices;
  if (info.rig && !info.base_from_camera)
    run.notices.push_back("no registration is stored with it: the filter ran on kinematics alone");
  if (info.own_kinematics)
    run.notices.push_back("its reference is the robot's own kinematics: these are differences, not errors");
  return run;
}

enum class Reference { kNeeded, kOptional };

ErrorRun trackFile(const fs::path& recording, const fs::path& robot, Reference reference,
                   const RunWatch& watch, base::Progress& progress) {
  progress.report(0.0, "opening");
  const robot::Description believed = robot::readDescriptionOrDefault(robot);
  ErrorRun names;
  names.motion = motionOf(recording);  // before it is opened: closing a file removes SQLite's locks
  names.files = {recording};
  names.title = recording.filename().string();
  names.trial = recording.stem().string();
  names.name = experiments::fileNameOf(names.trial);
  const auto source = recording::openRecording(recording, believed);
  const tracking::SourceInfo& info = source->info();
  if (reference == Reference::kNeeded && !info.reference && !info.own_kinematics)
    refuse(recording.string(), {}, {}, "holds no joint encoders, so its errors are not known",
           "Choose a recording with a reference (columns q1, q2, q3 of a table)");
  if (robot.empty()) {
    const bool own = robot::formatDescription(info.robot) != robot::formatDescription(believed);
    names.filter_robot = info.robot.name + (own ? " (the recording's own)" : "");
  } else {
    names.filter_robot = robot.filename().string();
    names.title += ", " + robot.stem().string();
    names.name += "-" + experiments::fileNameOf(robot.stem().string());
  }
  names.kinematic_robot = names.filter_robot;
  return trackSource(*source, robot.empty() ? info.robot : believed, std::move(names), watch, progress);
}

void requireResults(const fs::path& folder) {
  std::error_code fault;
  if (fs::exists(folder / "results.json", fault)) return;
  const auto within = resultsWithin(folder);
  refuse(folder.string(), {}, {}, "holds no results of an experiment (results.json)",
         within.empty() ? "Choose a folder that capstan-cli experiment has written"
                        : fmt::format("Choose one of its folders: {}", fmt::join(within, ", ")));
}

}  // namespace

void ErrorRun::addMoments(experiments::Estimator which, const Eigen::Vector3d& error, bool occluded) {
  auto& sums = moments[static_cast<std::size_t>(which)];
  for (const TimeShare share : {TimeShare::kAll, occluded ? TimeShare::kOccluded : TimeShare::kVisible})
    sums[static_cast<std::size_t>(share)].add(error);
}

bool sameMotion(const ErrorRun& a, const ErrorRun& b) {
  return (!a.motion.empty() && a.motion == b.motion) || anyFileIn(a, b) || anyFileIn(b, a);
}

ErrorCollector::ErrorCollector(std::size_t capacity)
    : errors_(capacity, std::min(capacity, kCapacity)),
      camera_(capacity / kRowsPerPair, std::min(capacity, kCapacity) / kRowsPerPair) {}

void ErrorCollector::take(const tracking::Snapshot& s) {
  if (s.camera_updated && s.gate == tracking::Gate::kOpen) takeCamera(s);
  if (!s.reference_paired) return;
  const Eigen::Vector3d kinematic = s.q_link_kin - s.q_link_true, ukf = s.q_link_ukf - s.q_link_true;
  const bool hidden = occluded(s);
  const std::lock_guard lock(mutex_);
  for (const experiments::Estimator which :
       {experiments::Estimator::kKinematic, experiments::Estimator::kIdentified})
    sums_.addMoments(which, kinematic, hidden);
  sums_.addMoments(experiments::Estimator::kUkf, ukf, hidden);
  errors_.add({s.t, kinematic, kinematic, ukf, hidden});
}

void ErrorCollector::takeCamera(const tracking::Snapshot& s) {
  const Eigen::Vector3d error = s.q_link_cam - s.q_link_true_cam;
  if (!error.allFinite()) return;
  const std::lock_guard lock(mutex_);
  sums_.addMoments(experiments::Estimator::kCamera, error, false);
  camera_.add({s.t_cam, s.q_link_cam, error});
}

void ErrorCollector::restart() {
  const std::lock_guard lock(mutex_);
  errors_.clear();
  camera_.clear();
  sums_ = {};
}

ErrorRun ErrorCollector::run() const {
  const std::lock_guard lock(mutex_);
  ErrorRun run;
  run.moments = sums_.moments;
  run.errors = errors_.points();
  run.camera = camera_.points();
  if (!run.errors.empty()) {
    run.begin = run.errors.front().t;
    run.end = run.errors.back().t;
  }
  return run;
}

ErrorRun trackRun(const fs::path& recording, const fs::path& robot, base::Progress& progress,
                  const RunWatch& watch) {
  return trackFile(recording, robot, Reference::kOptional, watch, progress);
}

ErrorRun trackErrors(const fs::path& recording, const fs::path& robot, base::Progress& progress) {
  ErrorRun run = trackFile(recording, robot, Reference::kNeeded, {}, progress);
  if (!progress.cancelled() && run.errors.empty())
    refuse(recording.string(), {}, {},
           "holds no instant at which motors and joint encoders were read together",
           "Choose a recording whose reference was sampled with the motors");
  return run;
}

ErrorRun readErrors(const fs::path& folder, const std::string& trial) {
  requireResults(folder);
  experiments::Results results = experiments::readResults(folder);
  std::vector<std::string> names;
  for (const experiments::TrialResult& one : results.trials)
    if (!one.errors.empty()) names.push_back(one.name);
  if (names.empty())
    refuse((folder / "results.json").string(), {}, {}, "holds no trial with errors",
           "Choose results of an experiment that tracks a robot with joint encoders (as C or D)");
  const std::string& wanted = trial.empty() ? names.front() : trial;
  const auto found = std::find_if(
      results.trials.begin(), results.trials.end(),
      [&](const experiments::TrialResult& one) { return one.name == wanted && !one.errors.empty(); });
  if (found == results.trials.end())
    refuse((folder / "results.json").string(), "trial", wanted, "is none of its trials with errors",
           fmt::format("Choose one of: {}", fmt::join(names, ", ")));
  ErrorRun run;
  run.title = fmt::format("{}, {}", results.name, found->name);
  run.motion = motionOf(*found);
  run.own_kinematics = found->own_kinematics;
  for (std::size_t i = 0; i < experiments::kEstimators; ++i)
    run.moments[i][0] = ErrorMoments::ofRms(found->rms[i], found->counts[i]);
  run.kinematic_robot = experiments::kinematicRobotOf(*found);
  run.filter_robot = experiments::filterRobotOf(results, *found);
  run.errors = std::move(found->errors);
  run.camera = std::move(found->camera);
  std::erase_if(run.camera, [](const experiments::CameraPoint& point) { return !point.error.allFinite(); });
  run.begin = run.errors.front().t;
  run.end = run.errors.back().t;
  run.trials = std::move(names);
  if (run.own_kinematics)
    run.notices.push_back("its reference is the robot's own kinematics: these are differences, not errors");
  return run;
}

}  // namespace capstan::analysis
