#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "core/analysis/error_moments.h"
#include "core/analysis/kept_points.h"
#include "core/base/progress.h"
#include "core/experiments/results.h"

namespace capstan::analysis {

/// Which instants count. A camera sample that the filter took is always a seen one.
enum class TimeShare { kAll, kOccluded, kVisible };
inline constexpr std::size_t kTimeShares = 3;

/// Errors of one run of a robot, wherever they came from: the only numbers that panels, histograms, box
/// plots, tables and comparisons are made of. SI: rad, rad, m.
///
/// Kinematic errors are of one robot, the one that the filter assumed; only in a trial of an experiment
/// are they of the nominal robot. Both are named.
struct ErrorRun {
  std::string title = {};  ///< "trial.capstan", "C, trial 3"
  /// Names the motion that was measured: runs of one recording, or of one simulated trial, have the same, so
  /// that their samples pair. Empty: unknown. See sameMotion().
  std::string motion = {};
  bool own_kinematics = false;    ///< differences from the robot's own kinematics, no errors
  double begin = 0.0, end = 0.0;  ///< [s]
  std::vector<experiments::ErrorPoint> errors = {};   ///< every one, or equally thinned where memory was full
  std::vector<experiments::CameraPoint> camera = {};  ///< samples that the filter took, at their own times
  std::vector<std::string> trials = {};               ///< that the results it was read from have errors of
  std::vector<std::string> notices = {};              ///< for the user, a line each
  bool simulated = false;                             ///< no real robot
  std::vector<experiments::TrajectoryPoint> trajectory = {};  ///< of a session or a recording (SessionMotion)
  std::string kinematic_robot = {};  ///< whose transmission kinematics `kinematic` is, by name
  std::string filter_robot = {};     ///< that the filter assumed, by name
  /// Files that hold the motion: what was read; of a session what it replays and what it has recorded.
  std::vector<std::filesystem::path> files = {};
  std::string name = "session", trial = "session";  ///< what its files are called in an export
  /// Over every sample, however thinned `errors` and `camera` are. n = 0: not known; then the points count.
  std::array<std::array<ErrorMoments, kTimeShares>, experiments::kEstimators> moments = {};

  const ErrorMoments& momentsOf(experiments::Estimator which, TimeShare share) const {
    return moments[static_cast<std::size_t>(which)][static_cast<std::size_t>(share)];
  }
  void addMoments(experiments::Estimator which, const Eigen::Vector3d& error, bool occluded);
};

/// Both are of one motion: `motion` is the same, or one of the files is, by path or by bytes.
bool sameMotion(const ErrorRun& a, const ErrorRun& b);

/// Gathers the errors of a running pipeline: kinematic and UKF estimates wherever a reference meets a motor
/// sample, the camera wherever the filter took it. `occluded` is the state of the newest camera sample: the
/// marker is hidden from a camera, or samples stay away. May be read from another thread. Its memory is fixed
/// (kCapacity points): when it is full, every other point goes; the moments stay those of every sample.
class ErrorCollector {
 public:
  static constexpr std::size_t kCapacity = std::size_t{1} << 19;  ///< nine minutes at 1 kHz

  explicit ErrorCollector(std::size_t capacity = kCapacity);

  /// Every snapshot, in order. Allocates nothing up to kCapacity points.
  void take(const tracking::Snapshot& snapshot);
  /// Forgets everything.
  void restart();
  /// Errors so far, without title, motion, names and notices.
  ErrorRun run() const;

 private:
  void takeCamera(const tracking::Snapshot& snapshot);

  mutable std::mutex mutex_;
  KeptPoints<experiments::ErrorPoint> errors_;
  KeptPoints<experiments::CameraPoint> camera_;
  ErrorRun sums_;  ///< its moments
};

/// Tracks a recording (session, measured table, motor log) and gathers its errors. `robot`: robot file that
/// the estimator assumes, empty: the recording's own (a recording without one: the left RAVEN-II).
/// Kinematic errors are of that robot's kinematics. Nothing is worth keeping when `progress` was cancelled.
/// Throws base::InputError for what cannot be read, and for a recording without reference. The only way to
/// the errors of a recording: the window, its exports and `capstan-cli figures` all come here.
ErrorRun trackErrors(const std::filesystem::path& recording, const std::filesystem::path& robot,
                     base::Progress& progress);
/// The same; a recording without reference has a trajectory and no errors.
ErrorRun trackRun(const std::filesystem::path& recording, const std::filesystem::path& robot,
                  base::Progress& progress);

/// Errors of one trial of an experiment's results (a folder with results.json); empty `trial`: the first that
/// has errors. Kinematic errors are of the nominal robot, time is occluded where the experiment blocked the
/// cameras; RMS are those that the results hold. Throws base::InputError as readResults() does, for an
/// unknown trial, and for results without errors.
ErrorRun readErrors(const std::filesystem::path& folder, const std::string& trial = {});

}  // namespace capstan::analysis

template <>
struct capstan::base::NamesOf<capstan::analysis::TimeShare> {
  using S = capstan::analysis::TimeShare;
  static constexpr std::array value = {std::pair{S::kAll, "all"}, std::pair{S::kOccluded, "occluded"},
                                       std::pair{S::kVisible, "seen"}};
};
