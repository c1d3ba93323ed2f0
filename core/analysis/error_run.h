#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/analysis/error_moments.h"
#include "core/analysis/kept_points.h"
#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/tracking/source.h"

namespace capstan::analysis {

/// Selection of instants. A camera sample that the filter accepted is always visible.
enum class TimeShare { kAll, kOccluded, kVisible };
inline constexpr std::size_t kTimeShares = 3;

/// Errors of one run of a robot from any source: a session, a recording or an experiment. All panels,
/// histograms, box plots, tables and comparisons use these numbers. SI: rad, rad, m.
///
/// Kinematic errors are those of the robot that the filter assumed; in a trial of an experiment, those of the
/// nominal robot. Both robots are named.
struct ErrorRun {
  std::string title = {};  ///< "trial.capstan", "C, trial 3"
  /// Name of the measured motion. Runs of one recording, or of one simulated trial, have the same name, so
  /// that their samples pair. Empty: not known. See sameMotion().
  std::string motion = {};
  bool own_kinematics = false;    ///< true: differences from the robot's own kinematics, not errors
  double begin = 0.0, end = 0.0;  ///< times of the first and the last sample [s]
  std::vector<experiments::ErrorPoint> errors = {};  ///< all errors, or equally thinned where memory was full
  std::vector<experiments::CameraPoint> camera = {};  ///< samples that the filter accepted
  std::vector<std::string> trials = {};               ///< trials with errors in the results that were read
  std::vector<std::string> notices = {};              ///< notices for the user, one line each
  bool simulated = false;                             ///< true: no real robot
  std::vector<experiments::TrajectoryPoint> trajectory = {};  ///< of a session or a recording
  std::string kinematic_robot = {};                           ///< name of the robot of the kinematic errors
  std::string filter_robot = {};                              ///< name of the robot that the filter assumed
  /// Files with the motion: the file that was read; for a session, its replayed and its recorded file.
  std::vector<std::filesystem::path> files = {};
  std::string name = "session", trial = "session";  ///< names of its files in an export
  /// Moments over all samples, also where `errors` and `camera` are thinned. With n = 0 they
  /// are not known, and the statistics are computed from the points.
  std::array<std::array<ErrorMoments, kTimeShares>, experiments::kEstimators> moments = {};

  const ErrorMoments& momentsOf(experiments::Estimator which, TimeShare share) const {
    return moments[static_cast<std::size_t>(which)][static_cast<std::size_t>(share)];
  }
  void addMoments(experiments::Estimator which, const Eigen::Vector3d& error, bool occluded);
};

/// True when both runs are of one motion: equal `motion`, or a common file, by path or by bytes.
bool sameMotion(const ErrorRun& a, const ErrorRun& b);

/// Collects the errors of a running pipeline: of kinematic and UKF estimates where a reference coincides with
/// a motor sample, and of the camera where the filter accepted it. ErrorPoint::occluded is
/// true if a marker was hidden in the newest camera sample, or if camera samples are missing. Another thread
/// may read it. The memory is fixed (kCapacity points) and taken at once: when it is full, every second point
/// is dropped; the moments remain those of all samples.
class ErrorCollector {
 public:
  static constexpr std::size_t kCapacity = std::size_t{1} << 19;  ///< points of nine minutes at 1 kHz
  /// Rows per image pair, at least: there is room for kCapacity / kRowsPerPair camera points.
  static constexpr std::size_t kRowsPerPair = 8;

  explicit ErrorCollector(std::size_t capacity = kCapacity);

  /// Takes every snapshot, in order. Allocates nothing up to kCapacity points.
  void take(const tracking::Snapshot& snapshot);
  /// Deletes all errors.
  void restart();
  /// Returns the present errors, without title, motion, names and notices.
  ErrorRun run() const;

 private:
  void takeCamera(const tracking::Snapshot& snapshot);

  mutable std::mutex mutex_;
  KeptPoints<experiments::ErrorPoint> errors_;
  KeptPoints<experiments::CameraPoint> camera_;
  ErrorRun sums_;  ///< only its moments are used
};

/// Tracks a recording (session, measured table, motor log) and returns its errors. `robot`: robot file that
/// the estimator assumes; empty: that of the recording, or the left RAVEN-II if it has none. Kinematic errors
/// are those of the same robot. The result is unusable when `progress` was cancelled. Throws base::InputError
/// for unreadable files and for a recording without reference. The window, its exports and `capstan-cli
/// figures` all use this function.
ErrorRun trackErrors(const std::filesystem::path& recording, const std::filesystem::path& robot,
                     base::Progress& progress);
/// What trackRun() meets on its way: the source with the robot that the estimator assumes, then each
/// snapshot.
struct RunWatch {
  std::function<void(const tracking::SourceInfo&)> begin = [](const tracking::SourceInfo&) {};
  std::function<void(const tracking::Snapshot&)> take = [](const tracking::Snapshot&) {};
};
/// As trackErrors(), but accepts a recording without reference: it has a trajectory and no errors.
ErrorRun trackRun(const std::filesystem::path& recording, const std::filesystem::path& robot,
                  base::Progress& progress, const RunWatch& watch = {});

/// Reads the errors of one trial from an experiment's results (a folder with results.json); empty `trial`:
/// the first one with errors. Kinematic errors are those of the nominal robot. Occluded time is that of
/// blocked cameras. RMS values are those of the results. Throws base::InputError as readResults() does, for
/// an unknown trial, and for results without errors.
ErrorRun readErrors(const std::filesystem::path& folder, const std::string& trial = {});

}  // namespace capstan::analysis

template <>
struct capstan::base::NamesOf<capstan::analysis::TimeShare> {
  using S = capstan::analysis::TimeShare;
  static constexpr std::array value = {std::pair{S::kAll, "all"}, std::pair{S::kOccluded, "occluded"},
                                       std::pair{S::kVisible, "seen"}};
};
