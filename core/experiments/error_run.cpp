#include "core/experiments/error_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/session/table_source.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;

/// Points of a whole recording are kept: eleven days at kRate.
constexpr std::size_t kRecordingCapacity = 100'000'000;

bool occluded(const tracking::Snapshot& s) {
  return tracking::markerLost(s) || (s.camera_samples > 0 && s.gate == tracking::Gate::kNoCamera);
}

template <class T>
void dropEveryOther(std::vector<T>& points) {
  for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
  points.resize((points.size() + 1) / 2);
}

[[noreturn]] void refuse(const std::string& file, std::string key, std::string value, std::string reason,
                         std::string remedy) {
  throw base::InputError({file, 0, std::move(key), std::move(value), std::move(reason), std::move(remedy)});
}

/// The bytes of a recording, whatever it is called: as at the end of TrialInputs::recording.
std::string motionOf(const fs::path& recording) { return "checksum " + base::checksumOfFile(recording); }

std::string motionOf(const TrialResult& trial) {
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

void requireResults(const fs::path& folder) {
  std::error_code fault;
  if (fs::exists(folder / "results.json", fault)) return;
  const auto within = resultsWithin(folder);
  refuse(folder.string(), {}, {}, "holds no results of an experiment (results.json)",
         within.empty() ? "Choose a folder that capstan-cli experiment has written"
                        : fmt::format("Choose one of its folders: {}", fmt::join(within, ", ")));
}

}  // namespace

ErrorCollector::ErrorCollector(double rate, std::size_t capacity)
    : capacity_(capacity), rate_asked_(rate), rate_(rate), due_(rate) {
  errors_.reserve(std::min(capacity_, kCapacity));
  camera_.reserve(std::min(capacity_, kCapacity));
}

void ErrorCollector::take(const tracking::Snapshot& s) {
  if (s.camera_updated && s.gate == tracking::Gate::kOpen) takeCamera(s);
  if (!s.reference_paired) return;
  const std::lock_guard lock(mutex_);
  if (!due_.due(s.t)) return;
  if (errors_.size() == capacity_) {
    dropEveryOther(errors_);
    rate_ *= 0.5;
    due_ = session::DueTimes(rate_);
    (void)due_.due(errors_.back().t);
    if (!due_.due(s.t)) return;
  }
  const Eigen::Vector3d kinematic = s.q_link_kin - s.q_link_true;
  errors_.push_back({s.t, kinematic, kinematic, s.q_link_ukf - s.q_link_true, occluded(s)});
}

void ErrorCollector::takeCamera(const tracking::Snapshot& s) {
  const Eigen::Vector3d error = s.q_link_cam - s.q_link_true_cam;
  if (!error.allFinite()) return;
  const std::lock_guard lock(mutex_);
  if (camera_count_++ % camera_stride_ != 0) return;
  if (camera_.size() == capacity_) {
    dropEveryOther(camera_);
    camera_stride_ *= 2;
  }
  camera_.push_back({s.t_cam, s.q_link_cam, error});
}

void ErrorCollector::restart() {
  const std::lock_guard lock(mutex_);
  errors_.clear();
  camera_.clear();
  rate_ = rate_asked_;
  due_ = session::DueTimes(rate_);
  camera_stride_ = 1;
  camera_count_ = 0;
}

ErrorRun ErrorCollector::run() const {
  const std::lock_guard lock(mutex_);
  ErrorRun run;
  run.errors = errors_;
  run.camera = camera_;
  if (!errors_.empty()) {
    run.begin = errors_.front().t;
    run.end = errors_.back().t;
  }
  return run;
}

ErrorRun trackErrors(session::Source& source, const robot::Description& robot, base::Progress& progress) {
  session::SourceInfo info = source.info();
  if (!info.reference && !info.own_kinematics)
    refuse(info.title, {}, {}, "holds no joint encoders, so its errors are not known",
           "Choose a recording with a reference (columns q1, q2, q3 of a table)");
  info.robot = robot;
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info);
  ErrorCollector collector(ErrorCollector::kRate, kRecordingCapacity);
  tracking::trackAll(
      source, pipeline, &progress, info.duration,
      [&](const tracking::Sample&, const tracking::Snapshot& snapshot) { collector.take(snapshot); });
  ErrorRun run = collector.run();
  run.title = info.title;
  run.own_kinematics = info.own_kinematics;
  run.notices = info.notices;
  if (info.rig && !info.base_from_camera)
    run.notices.push_back("no registration is stored with it: the filter ran on kinematics alone");
  if (info.own_kinematics)
    run.notices.push_back("its reference is the robot's own kinematics: these are differences, not errors");
  return run;
}

ErrorRun trackErrors(const fs::path& recording, const fs::path& robot, base::Progress& progress) {
  progress.report(0.0, "opening");
  const robot::Description believed =
      robot::readDescription(robot.empty() ? base::resource("robots/raven2_left.yaml") : robot);
  std::string motion = motionOf(recording);  // before it is opened: closing a file takes SQLite's locks away
  const auto source = session::openRecording(recording, believed);
  ErrorRun run = trackErrors(*source, robot.empty() ? source->info().robot : believed, progress);
  if (!progress.cancelled() && run.errors.empty())
    refuse(recording.string(), {}, {},
           "holds no instant at which motors and joint encoders were read together",
           "Choose a recording whose reference was sampled with the motors");
  run.title = recording.filename().string();
  if (!robot.empty()) run.title += ", " + robot.stem().string();
  run.motion = std::move(motion);
  return run;
}

ErrorRun readErrors(const fs::path& folder, const std::string& trial) {
  requireResults(folder);
  Results results = readResults(folder);
  std::vector<std::string> names;
  for (const TrialResult& one : results.trials)
    if (!one.errors.empty()) names.push_back(one.name);
  if (names.empty())
    refuse((folder / "results.json").string(), {}, {}, "holds no trial with errors",
           "Choose results of an experiment that tracks a robot with joint encoders (as C or D)");
  const std::string& wanted = trial.empty() ? names.front() : trial;
  const auto found = std::find_if(results.trials.begin(), results.trials.end(), [&](const TrialResult& one) {
    return one.name == wanted && !one.errors.empty();
  });
  if (found == results.trials.end())
    refuse((folder / "results.json").string(), "trial", wanted, "is none of its trials with errors",
           fmt::format("Choose one of: {}", fmt::join(names, ", ")));
  ErrorRun run;
  run.title = fmt::format("{}, {}", results.name, found->name);
  run.motion = motionOf(*found);
  run.own_kinematics = found->own_kinematics;
  run.errors = std::move(found->errors);
  run.camera = std::move(found->camera);
  std::erase_if(run.camera, [](const CameraPoint& point) { return !point.error.allFinite(); });
  run.begin = run.errors.front().t;
  run.end = run.errors.back().t;
  run.trials = std::move(names);
  if (run.own_kinematics)
    run.notices.push_back("its reference is the robot's own kinematics: these are differences, not errors");
  return run;
}

}  // namespace capstan::experiments
