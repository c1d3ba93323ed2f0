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
#include "core/tracking/pipeline.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

namespace capstan::live {

enum class RunState { kPaused, kRunning, kEnded, kFailed };

struct RunnerOptions {
  double speed = 1.0;  ///< recording seconds a second, 0.25…10; 0: as fast as possible
  static constexpr double kHistoryRate =
      200.0;  ///< snapshots for plots between camera updates [1/s of recording]
  static constexpr std::size_t kHistoryCapacity = 16384;  ///< the oldest make room when nobody drains
  static constexpr double kEstimateRate =
      1000.0;  ///< snapshots recorded [1/s of recording], camera updates always
};

struct RunStatus {
  RunState state = RunState::kPaused;
  std::string error;          ///< of kFailed
  std::string command_fault;  ///< of the last command that failed, which stops nothing
  std::uint64_t command_fault_count = 0;
  double t = 0.0;                 ///< newest arrival [s]
  double speed = 1.0;             ///< requested
  double real_time_factor = 0.0;  ///< reached, over the last second
  double motor_rate = 0.0;        ///< [1/s of recording]
  double frame_rate = 0.0;        ///< frames or tip samples [1/s of recording]
  std::array<bool, 2> blocked{};  ///< left, right: now, by hand or by schedule
  OcclusionSchedule occlusion;
  bool occlusion_added = false;  ///< something is blocked now or by schedule, and the source is a recording
  std::optional<recording::RecorderStats> recorder;  ///< while recording, and of the last recording
  std::string recording;                             ///< its path
};

/// Hears what the pipeline makes of every sample, on the pipeline's thread: must be quick and must not throw.
struct Listener {
  /// Before the first sample, and again when robot or registration have changed.
  std::function<void(const tracking::TrackingPipeline&)> begin;
  std::function<void(const tracking::Sample&, const tracking::Snapshot&)> take;

  explicit operator bool() const { return static_cast<bool>(take); }
};

/// Runs a source through a pipeline on a thread of its own: paces it, applies occlusion, records, and
/// publishes what views want. Every call returns at once (startRecording() creates a file); starts paused.
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
  void stepFrame();  ///< runs, unpaced, through the next camera sample (without cameras: 1/15 s), then pauses
  void setSpeed(double speed);

  // Occlusion, as recordings made meanwhile keep it in events; a source that is a recording itself has it
  // added, and the events report it.
  void block(bool left, bool right);  ///< by hand, from now on
  void setOcclusion(const OcclusionSchedule& schedule);
  void setRegistration(const Eigen::Isometry3d& base_from_camera);
  /// The pipeline is rebuilt for `robot`, with options, registration and declared faults as they are, from
  /// the next sample on; report() restarts, recordings carry it, one under way gets `note` as event
  /// "robot". Throws base::InputError for a robot that the pipeline cannot take; then nothing changes.
  void setRobot(const robot::Description& robot, const std::string& note);
  robot::Description robot() const;  ///< in use
  /// From the next sample on, in place of the one before; {}: nobody, which costs nothing.
  void listen(Listener listener);
  void resetErrors();  ///< report() restarts
  void note(std::string text);

  /// On the pipeline's thread, between two samples; in order of posting.
  using Command = std::function<void(tracking::Source&, tracking::TrackingPipeline&)>;
  void post(Command command);

  /// Creates the file here, records from the next sample on. Adds the robot, the registration and the
  /// tracking options in use to `header`. A recording under way is stopped. Throws base::InputError when the
  /// file cannot be created.
  void startRecording(const std::filesystem::path& path, recording::SessionHeader header,
                      const recording::RecorderOptions& options = {});
  void stopRecording();  ///< the file is closed in the background
  /// The present recorder or the last one, closed once this runner is gone; null: none yet.
  std::shared_ptr<const recording::Recorder> recorder() const;

  RunStatus status() const;
  /// Over every step since the start or resetErrors(); at most 0.1 s old.
  tracking::TrackReport report() const;
  /// The newest snapshot into `out`; false when it was taken before.
  bool takeSnapshot(tracking::Snapshot& out);
  /// The newest frames, as the pipeline saw them; `out`'s images are exchanged, not copied. `seen`: what the
  /// pipeline made of exactly these frames, for overlays. False: none since the last.
  bool takeFrames(tracking::StereoFrame& out, tracking::Snapshot* seen = nullptr);
  /// Appends to `out` every camera update and about history_rate others since the last call, in order.
  /// Returns how many.
  std::size_t drainHistory(std::vector<tracking::Snapshot>& out);

  /// Waits until the source has ended, failed or paused; false after `seconds`. For headless runs and tests.
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
