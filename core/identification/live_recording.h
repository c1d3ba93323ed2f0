#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/identification/identification_data.h"
#include "core/tracking/pipeline.h"

namespace capstan::identification {

/// Contents of a live recording.
struct LiveExtent {
  double seconds = 0.0;            ///< time from the first to the newest motor sample, pauses included [s]
  std::uint64_t motors = 0;        ///< number of motor samples
  std::uint64_t cameras = 0;       ///< number of camera samples, with or without the tip
  std::uint64_t observations = 0;  ///< number of camera samples with the tip observed and within reach
  std::uint64_t restarts = 0;      ///< number of restarts; see LiveRecording::take()
  bool motor_failed = false;       ///< true: an encoder has failed; no samples are taken any more
  bool registered = true;          ///< true: by the newest frame, the cameras are registered
  bool full = false;               ///< true: the longest duration is reached; no samples are taken any more
};

/// Text for people: the extent, or the reason why nothing is recorded.
std::string wordsOf(const LiveExtent& extent);

/// A recording that grows during a session. The pipeline's thread adds samples, each at the cost of a short
/// lock and a copy. Any other thread reads the present contents without waiting.
class LiveRecording {
 public:
  static constexpr double kLongest = 1200.0;  ///< longest duration [s]

  explicit LiveRecording(std::string title, double longest = kLongest);

  // Called by the pipeline's thread.
  /// Call it before the first sample of `pipeline`. The recording continues after a pause if robot and
  /// registration are the same; else it restarts.
  void begin(const tracking::TrackingPipeline& pipeline);
  /// Takes motor samples that the pipeline accepted, and all camera samples. The recording restarts when the
  /// motor clock is set back.
  void take(const tracking::Sample& sample, const tracking::Snapshot& snapshot);

  // Called by any thread.
  LiveExtent extent() const;
  /// Returns all data for identification; empty before begin(). Call it from one thread at a time.
  IdentificationData data();

 private:
  struct Motor {
    double t;
    Eigen::Vector3d position, velocity;
    std::array<tracking::MotorFault, 3> failed;
  };

  void restart();
  void takeMotors(const tracking::Snapshot& snapshot);
  void feed(const std::vector<Motor>& motors, const std::vector<tracking::Snapshot>& cameras);

  const std::string title_;
  const double longest_;
  mutable std::mutex mutex_;  ///< guards motors_ to extent_
  std::vector<Motor> motors_;
  std::vector<tracking::Snapshot> cameras_;
  std::optional<DataCollector> blank_;  ///< empty collector for the present pipeline
  bool restarted_ = false;              ///< true: data() starts again from blank_
  std::string robot_;
  std::optional<Eigen::Isometry3d> registration_;
  double first_ = 0.0, last_ = 0.0;
  std::array<tracking::MotorFault, 3> failed_{};
  LiveExtent extent_;

  std::optional<DataCollector> collector_;  ///< used only by the thread that calls data()
  std::uint64_t fed_ = 0;
};

}  // namespace capstan::identification
