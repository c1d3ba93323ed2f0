#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/robot/description.h"
#include "core/tracking/sample.h"
#include "core/vision/camera.h"

namespace capstan::tracking {

/// Information that a source has before its first sample.
struct SourceInfo {
  std::string title;                     ///< for the window's title and reports
  robot::Description robot;              ///< nominal robot, known to the estimator
  std::optional<vision::StereoRig> rig;  ///< present with images only
  /// Registration stored with the recording. For images without a stored registration the user registers
  /// first.
  std::optional<Eigen::Isometry3d> base_from_camera;
  std::string truth;       ///< truth file text of a simulation, else empty
  std::string marker;      ///< marker options (YAML) stored with the recording, else empty
  std::string tracking;    ///< tracking options (YAML) stored with the recording, else empty
  double begin = 0.0;      ///< time of the first sample [s]
  double duration = 0.0;   ///< from the first sample to the last [s]; 0: unknown (live)
  bool reference = false;  ///< the robot has joint encoders
  /// True if the joint encoder columns hold the robot's own transmission kinematics, which is no truth.
  bool own_kinematics = false;
  bool live = false;                 ///< the robot can be commanded (simulated or real)
  bool real_time = false;            ///< samples come when they are measured: not paced, not stepped
  bool sender_waits = false;         ///< a real-time source on standard input: nothing has to be dropped
  std::vector<std::string> notices;  ///< exclusions and remarks for the user, one per line
};

/// Clock of a device, as estimated from its stamps and their arrivals.
struct SideClock {
  std::uint64_t steps = 0;                  ///< jumps
  double last_step = 0.0;                   ///< size of the last jump; positive: ahead [s]
  double offset = 0.0, offset_sigma = 0.0;  ///< session's clock − device's clock [s]
  double drift = 0.0, drift_sigma = 0.0;    ///< gain of the session's clock on the device's [s/s]
  double mean_delay = 0.0;                  ///< of arrivals, above the smallest [s]
};

/// Time from the arrival of a sample at this program to its estimate, over the newest samples of a side [s].
struct SideLatency {
  double median = 0.0, p99 = 0.0;
};

/// Joint encoders that come as messages of their own.
struct EncoderStatus {
  enum class State { kUsed, kSilent, kOtherStamps, kLate };
  State state = State::kUsed;   ///< others: why the newest rows have no joint encoders
  std::string from;             ///< address
  std::string reason;           ///< kSilent: why none come; empty: not known
  std::uint64_t unmatched = 0;  ///< rows whose encoders came with another stamp, and were excluded
  std::uint64_t late = 0;       ///< messages that came more than kWait after the row of their stamp
  /// Time for which a row waits for its encoders.
  static constexpr std::chrono::milliseconds kWait{20};
};

/// Condition of one side of a live source: its motors or its cameras.
struct SideStatus {
  enum class State { kWaiting, kReceiving, kSilent, kFrozen, kRefused, kEnded };
  std::string name;               ///< "motors", "cameras"
  std::string part;               ///< camera that is silent or frozen while the other is not: "left", "right"
  std::string counted = "row";    ///< what is counted, as one word: "row", "image"
  std::string from;               ///< address or device
  State state = State::kWaiting;  ///< kSilent: nothing for kSilence; kFrozen: only equal images for that
                                  ///< time; kRefused: `fault` disconnected it
  bool connected = false;         ///< kWaiting: a program is connected, and no valid row has come from it
  std::string fault;              ///< why this program disconnected another one last; empty: never
  std::string warning;            ///< what is wrong with data that are used; empty: nothing
  std::string reason;             ///< why nothing comes now; empty: not known, or something comes
  std::vector<std::string> notices;  ///< remarks on what the connected program sends, one per line
  double silent_for = 0.0;           ///< time since the last sample, or the last new image [s]
  std::uint64_t received = 0;        ///< number taken
  std::uint64_t repeated = 0;        ///< excluded, since their stamps did not rise
  std::uint64_t missing = 0;  ///< rows that never came, or pairs of images of which neither came, by the
                              ///< gaps in their times
  std::uint64_t dropped = 0;  ///< excluded, since tracking was too slow
  double backlog = 0.0;       ///< time since the arrival of the oldest sample that tracking has not taken [s]
  std::uint64_t unpaired = 0;    ///< images excluded, since the other camera gave none at their time
  std::uint64_t frozen = 0;      ///< images that equal the one before; their pairs are excluded
  std::uint64_t undated = 0;     ///< pairs of images excluded, while it was not known whose clock stamps them
  std::uint64_t incomplete = 0;  ///< rows excluded, since their connection ended within them
  std::uint64_t gaps = 0;        ///< intervals above kSilence in the times of rows or pairs
  double last_gap = 0.0;         ///< length of the newest of them [s]
  std::uint64_t connections = 0;  ///< number of times that a program has connected
  std::uint64_t refused = 0;      ///< of them, disconnected for `fault`
  /// By what the times of images are known.
  enum class Times { kStamps, kArrivals, kFile };
  std::optional<Times> times;      ///< of the newest images; none: no image so far, or the side has no images
  std::optional<SideClock> clock;  ///< of a device that stamps its samples itself
  std::optional<SideLatency> latency;
  EncoderStatus encoders;
  /// Shown within 0.5 s, since views ask every 0.1 s [s].
  static constexpr double kSilence = 0.35;
  /// Backlog from which it is reported [s]: images of 30 Hz may wait for each other.
  static constexpr double kLongBacklog = 0.3;
};

/// Yields samples in order of arrival. Deterministic sources yield the same bytes each time.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  /// Writes the next sample to `out`, whose images are reused. False: the source has ended.
  virtual bool next(tracking::Sample& out) = 0;
  /// Blocks (true) or unblocks the view of each camera from now on. Images then show the occlusion in their
  /// pixels, and StereoFrame::blocked.
  virtual void block(bool left, bool right) = 0;
  /// Waits up to `wait` for the next sample. True: next() returns at once. Only real-time sources wait.
  virtual bool ready(std::chrono::milliseconds wait) {
    (void)wait;
    return true;
  }
  /// Discards the samples that have come so far, of a real-time source.
  virtual void discard() {}
  /// Sides of a live source; none for others. Any thread may call it.
  virtual std::vector<SideStatus> sides() const { return {}; }
};

}  // namespace capstan::tracking

template <>
struct capstan::base::NamesOf<capstan::tracking::SideStatus::State> {
  using S = capstan::tracking::SideStatus::State;
  static constexpr std::array value = {
      std::pair{S::kWaiting, "waiting"}, std::pair{S::kReceiving, "receiving"},
      std::pair{S::kSilent, "silent"},   std::pair{S::kFrozen, "frozen"},
      std::pair{S::kRefused, "refused"}, std::pair{S::kEnded, "ended"}};
};

template <>
struct capstan::base::NamesOf<capstan::tracking::SideStatus::Times> {
  using T = capstan::tracking::SideStatus::Times;
  static constexpr std::array value = {std::pair{T::kStamps, "stamps"}, std::pair{T::kArrivals, "arrivals"},
                                       std::pair{T::kFile, "the file"}};
};
