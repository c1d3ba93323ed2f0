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

/// How much a live recording holds.
struct LiveExtent {
  double seconds = 0.0;            ///< from the first motor sample to the newest, pauses included
  std::uint64_t motors = 0;        ///< motor samples
  std::uint64_t cameras = 0;       ///< camera samples, the tip seen or not
  std::uint64_t observations = 0;  ///< of these, with the tip seen and within reach
  std::uint64_t restarts = 0;      ///< times that what was held became worthless: see LiveRecording::take()
  bool motor_failed = false;       ///< an encoder has failed; from then on nothing is taken
  bool registered = true;          ///< frames can be converted to joint angles, by the newest one
  bool full = false;               ///< the longest was reached, nothing more is taken
};

/// In plain words: what has come, or why nothing has.
std::string wordsOf(const LiveExtent& extent);

/// A recording that grows while a session runs. One thread, the pipeline's, puts samples in, which costs it
/// a short lock and a copy; any other takes what there is and waits for nothing.
class LiveRecording {
 public:
  static constexpr double kLongest = 1200.0;  ///< [s]

  explicit LiveRecording(std::string title, double longest = kLongest);

  // The pipeline's thread.
  /// Before the first sample of `pipeline`. What is held stays if robot and registration are the same, so
  /// that a recording goes on after a pause; else the recording restarts.
  void begin(const tracking::TrackingPipeline& pipeline);
  /// Motor samples that the pipeline took, and everything from a camera. A motor clock set back begins the
  /// recording again.
  void take(const tracking::Sample& sample, const tracking::Snapshot& snapshot);

  // Any thread.
  LiveExtent extent() const;
  /// All that is held, as identification needs it; empty before begin(). One thread at a time.
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
  mutable std::mutex mutex_;  ///< the inbox
  std::vector<Motor> motors_;
  std::vector<tracking::Snapshot> cameras_;
  std::optional<DataCollector> blank_;  ///< of the present pipeline
  bool restarted_ = false;              ///< data() starts from blank_
  std::string robot_;
  std::optional<Eigen::Isometry3d> registration_;
  double first_ = 0.0, last_ = 0.0;
  std::array<tracking::MotorFault, 3> failed_{};
  LiveExtent extent_;

  std::optional<DataCollector> collector_;  ///< of the thread that calls data()
  std::uint64_t fed_ = 0;
};

}  // namespace capstan::identification
