#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/live/occlusion.h"
#include "core/recording/recorder.h"
#include "core/tracking/health.h"
#include "core/tracking/pipeline.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"
#include "core/vision/image_correction.h"

namespace capstan::live {

enum class RunState { kPaused, kRunning, kEnded, kFailed };

struct RunnerOptions {
  double speed = 1.0;  ///< playback speed, recording time per wall time, 0.1…50; 0: as fast as possible
  /// Rate of snapshots for plots between camera updates [1/s of recording].
  static constexpr double kHistoryRate = 200.0;
  /// Number of snapshots in the history; new ones replace the oldest.
  static constexpr std::size_t kHistoryCapacity = 16384;
  /// Rate of recorded snapshots [1/s of recording]; camera updates are always recorded.
  static constexpr double kEstimateRate = 1000.0;
};

struct RunStatus {
  RunState state = RunState::kPaused;
  std::string error;          ///< reason of kFailed
  std::string damaged;        ///< session file that failed and can be recovered; empty: none
  std::string command_fault;  ///< error of the last failed command; the runner continues
  std::uint64_t command_fault_count = 0;
  double t = 0.0;                 ///< arrival of the newest sample [s]
  double speed = 1.0;             ///< requested speed
  double real_time_factor = 0.0;  ///< actual speed over the last second
  double motor_rate = 0.0;        ///< [1/s of recording]
  double frame_rate = 0.0;        ///< rate of frames or tip samples [1/s of recording]
  std::array<bool, 2> blocked{};  ///< left, right: blocked now, by hand or by schedule
  OcclusionSchedule occlusion;
  bool occlusion_added = false;  ///< the source is a recording, and a camera is blocked now or by schedule
  std::vector<tracking::SideStatus> sides;           ///< Source::sides()
  std::optional<recording::RecorderStats> recorder;  ///< statistics of the current or last recording
  std::string recording;                             ///< path of that recording
};

/// Callbacks for every sample and its snapshot, on the pipeline's thread: they must be quick and must not
/// throw.
struct Listener {
  /// Called before the first sample, and again after a change of robot or registration.
  std::function<void(const tracking::TrackingPipeline&)> begin;
  std::function<void(const tracking::Sample&, const tracking::Snapshot&)> take;

  explicit operator bool() const { return static_cast<bool>(take); }
};

/// A listener that passes everything to both, of which either may be empty.
Listener both(Listener one, Listener other);

/// Runs a source through a pipeline on its own thread: controls the speed, applies occlusion, records, and
/// publishes data for views. Every call returns at once (startRecording() creates a file first). A runner
/// starts paused.
class Runner {
 public:
  Runner(std::unique_ptr<tracking::Source> source, tracking::TrackingPipeline pipeline,
         const RunnerOptions& options = {});
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  const tracking::SourceInfo& info() const;

  void run();
  void pause();
  /// Runs at full speed up to and including the next camera sample (without cameras: 1/15 s), then pauses.
  void stepFrame();
  void setSpeed(double speed);

  // Occlusion. Recordings store it as events; if the source is itself a recording, the events report that the
  // occlusion was added.
  void block(bool left, bool right);  ///< blocks cameras by hand from now on
  void setOcclusion(const OcclusionSchedule& schedule);
  /// Registers the cameras from now on. report() restarts, unless the registration is the one in use.
  void setRegistration(const Eigen::Isometry3d& base_from_camera);
  /// Looks for another marker from the next images on. Recordings store its options.
  void setMarker(const vision::MarkerOptions& marker);
  /// Corrects all images from the next pair on, before they are tracked and recorded: of a source whose
  /// cameras are exchanged, mirrored or upside down. Replaces the former correction.
  void setImages(const vision::ImageCorrection& images);
  vision::ImageCorrection images() const;  ///< correction in use
  /// Rebuilds the pipeline for other cameras, as setRobot() does for another robot. The event is "cameras".
  void setRig(const vision::StereoRig& rig, const std::string& note);
  /// info() with robot, cameras, registration, marker and filter options in use.
  tracking::SourceInfo infoInUse() const;
  vision::MarkerOptions marker() const;  ///< options in use
  /// Rebuilds the pipeline for `robot` before the next sample; filter options, registration and declared
  /// faults stay. report() restarts. Later recordings store the robot, and a recording under way gets `note`
  /// as event "robot". Throws base::InputError for a robot that the pipeline does not support; then nothing
  /// changes.
  void setRobot(const robot::Description& robot, const std::string& note);
  robot::Description robot() const;  ///< robot in use
  /// Rebuilds the pipeline with other filter options before the next sample; robot, registration, marker and
  /// declared faults stay. report() restarts. Later recordings store the options, and a recording under way
  /// gets them as event "filter options". Throws base::InputError for options that the pipeline does not
  /// support; then nothing changes.
  void setTracking(const tracking::TrackingOptions& options);
  tracking::TrackingOptions tracking() const;  ///< options in use
  /// Sets the listener from the next sample on, in place of the former one; {}: no listener, at no cost.
  void listen(Listener listener);
  void resetErrors();  ///< report() restarts
  void note(std::string text);

  /// Command that is executed on the pipeline's thread between two samples, in order of posting.
  using Command = std::function<void(tracking::Source&, tracking::TrackingPipeline&)>;
  void post(Command command);

  /// `header` with the robot, registration, marker and tracking options in use now.
  recording::SessionHeader inUse(recording::SessionHeader header) const;
  /// Creates the file at once and records from the next sample on, under inUse(header). Stops a recording
  /// under way. Throws base::InputError if the file cannot be created.
  void startRecording(const std::filesystem::path& path, const recording::SessionHeader& header,
                      const recording::RecorderOptions& options = {});
  void stopRecording();  ///< closes the file in the background
  /// Current recorder, or the last one; null: none yet. It is closed when this runner is destroyed.
  std::shared_ptr<const recording::Recorder> recorder() const;

  RunStatus status() const;
  /// Report over every step since TrackReport::since; at most 0.1 s old.
  tracking::TrackReport report() const;
  /// Checks of the estimator over report(), for the robot in use.
  std::vector<tracking::HealthCheck> health() const;
  /// Copies the newest snapshot to `out`; false if it was taken before.
  bool takeSnapshot(tracking::Snapshot& out);
  /// Moves the newest frames of the pipeline to `out` by exchanging images without copying. `seen` receives
  /// the snapshot of exactly these frames, for overlays. False: no new frames since the last call.
  bool takeFrames(tracking::StereoFrame& out, tracking::Snapshot* seen = nullptr);
  /// Appends to `out`, in order, every camera update since the last call and the other snapshots at
  /// kHistoryRate. Returns their number.
  std::size_t drainHistory(std::vector<tracking::Snapshot>& out);

  /// Waits until the source has ended, failed or paused; false after `seconds`. For runs without a window and
  /// for tests.
  bool waitUntilIdle(double seconds);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::live

template <>
struct capstan::base::NamesOf<capstan::live::RunState> {
  using S = capstan::live::RunState;
  static constexpr std::array value = {std::pair{S::kPaused, "paused"}, std::pair{S::kRunning, "running"},
                                       std::pair{S::kEnded, "ended"}, std::pair{S::kFailed, "failed"}};
};
