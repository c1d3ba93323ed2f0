#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/session/due_times.h"
#include "core/session/source.h"

namespace capstan::experiments {

/// Errors of one run of a robot, wherever they came from: what histograms, box plots and comparisons are made
/// of. SI: rad, rad, m.
struct ErrorRun {
  std::string title = {};  ///< "trial.capstan", "C, trial 3"
  /// Names the motion that was measured: runs of one recording, or of one simulated trial, have the same, so
  /// that their samples pair. Empty: unknown.
  std::string motion = {};
  bool own_kinematics = false;                   ///< differences from the robot's own kinematics, no errors
  double begin = 0.0, end = 0.0;                 ///< of the errors [s]
  std::vector<ErrorPoint> errors = {};           ///< equally spaced in time, but for gaps
  std::vector<CameraPoint> camera = {};          ///< samples that the filter took, at their own times
  std::vector<std::string> trials = {};          ///< that the results it was read from have errors of
  std::vector<std::string> notices = {};         ///< for the user, a line each
  bool simulated = false;                        ///< of a running session: no real robot
  std::vector<TrajectoryPoint> trajectory = {};  ///< of a running session (SessionMotion)
};

/// Gathers the errors of a running pipeline: kinematic and UKF estimates at most `rate` times a second where
/// a reference meets a motor sample, the camera wherever the filter took it. `occluded` is what the newest
/// camera sample tells: the marker is hidden from a camera, or samples stay away. May be read from another
/// thread. Its memory is fixed (kCapacity points): when it is full, every other point goes and the rate is
/// halved.
class ErrorCollector {
 public:
  static constexpr std::size_t kCapacity = std::size_t{1} << 17;
  static constexpr double kRate = 100.0;  ///< [1/s]

  explicit ErrorCollector(double rate = kRate, std::size_t capacity = kCapacity);

  /// Every snapshot, in order. Allocates nothing.
  void take(const tracking::Snapshot& snapshot);
  /// Forgets everything.
  void restart();
  /// Errors so far, without title, motion and notices.
  ErrorRun run() const;

 private:
  void takeCamera(const tracking::Snapshot& snapshot);

  const std::size_t capacity_;
  const double rate_asked_;
  mutable std::mutex mutex_;
  double rate_;
  session::DueTimes due_;
  std::vector<ErrorPoint> errors_;
  std::vector<CameraPoint> camera_;
  std::uint64_t camera_stride_ = 1, camera_count_ = 0;
};

/// Tracks a recording (session, measured table, motor log) and gathers its errors. `robot`: robot file that
/// the estimator believes in, empty: the recording's own (a recording without one: the left RAVEN-II).
/// Kinematic errors are of that robot's kinematics. Nothing is worth keeping when `progress` was cancelled.
/// Throws base::InputError for what cannot be read, and for a recording without reference.
ErrorRun trackErrors(const std::filesystem::path& recording, const std::filesystem::path& robot,
                     base::Progress& progress);
/// The same of an open source.
ErrorRun trackErrors(session::Source& source, const robot::Description& robot, base::Progress& progress);

/// Errors of one trial of an experiment's results (a folder with results.json); empty `trial`: the first that
/// has errors. Kinematic errors are of the nominal robot, time is occluded where the experiment blocked the
/// cameras. Throws base::InputError as readResults() does, for an unknown trial, and for results without
/// errors.
ErrorRun readErrors(const std::filesystem::path& folder, const std::string& trial = {});

}  // namespace capstan::experiments
