#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/live/cameras/backlog.h"
#include "core/live/cameras/frame_pairer.h"
#include "core/live/cameras/video_stream.h"
#include "core/live/image_clock.h"
#include "core/live/live_setup.h"
#include "core/live/sample_queue.h"
#include "core/live/streams/clock_agreement.h"
#include "core/tracking/source.h"

namespace capstan::live {

class TopicHint;

/// Reads the images of one or two streams, or ROS topics, on threads of their own, pairs them, and puts the
/// pairs into a queue. A pair with an image that equals the one before is excluded, and counted as frozen. A
/// stream that ends or falls silent is opened again. A video file begins with the session: the time of an
/// image is its time in the file after the session's first sample. It comes after the motors of that time.
/// Images of a file that are late by more than 0.3 s are passed over, and counted as dropped.
/// Images of ROS topics, and of Motion JPEG over HTTP with X-Timestamp, are paired by their stamps
/// (ImageClock). The stamps are the times where they are by the clock of the motors' stamps, or by this
/// computer's clock; else their clock is mapped to this computer's. Other images are paired by the times at
/// which their driver had them, or at which they arrived; where network streams have no stamps, images that
/// have waited on their way (Backlog) are received, but not passed on. A reader that is behind drops
/// images; their pairs are counted as dropped.
class CameraSide {
 public:
  using Clock = std::chrono::steady_clock;
  /// The session's clock.
  struct SessionClock {
    /// Time at a time of this computer; nothing before the session has begun, and then images are not passed
    /// on.
    std::function<std::optional<double>(Clock::time_point)> at;
    /// Time of a ROS stamp [ns]; nothing where the motors have no such stamps.
    std::function<std::optional<double>(std::int64_t)> of_stamp;
    /// Time of the first sample; none: 0.
    std::function<double()> begin;
    /// Time of the newest motor sample; none: that of the clock.
    std::function<double()> newest;
    /// Number of steps of the clock that of_stamp maps to the session's; none: 0.
    std::function<int()> steps = {};
  };
  /// A network stream may come later. Throws base::InputError where a device or file cannot be opened.
  CameraSide(const CamerasSetup& setup, SessionClock clock, SampleQueue& queue);
  ~CameraSide();

  tracking::SideStatus status() const;

 private:
  void work(int stream);
  void workOnTopic(int stream, const std::string& topic);
  void noteHint(int stream, TopicHint& hint);
  void noteReason(int stream, std::string reason);
  void noteConnections(int stream, std::uint64_t count);
  void noteOpened(int stream);
  void readStream(int stream, VideoStream& video);
  /// When an image came. A stamp is by the clock of the device.
  struct Times {
    std::int64_t stamp = 0;     ///< [ns]; 0: none
    Clock::time_point arrival;  ///< at this computer
    double session = 0.0;       ///< on the session's clock, of an image of a file [s]
  };
  /// `lost`: number of images of the stream that were dropped before this one.
  void take(int stream, const cv::Mat& image, const Times& times, std::uint64_t lost);
  bool anyWaits(int stream, const Times& times);
  double pairingTime(int stream, const Times& times);
  Clock::time_point computerTime(double pairing_time) const;
  Clock::time_point onComputer(std::int64_t stamp);
  std::optional<double> observeExposure(const FramePair& pair);
  void pass(FramePair pair, Clock::time_point arrival);
  void waitToReopen() const;
  void waitForSession() const;
  Times waitUntilDue(double position) const;
  double latenessOf(double position) const;
  std::uint64_t catchUp(VideoStream& video) const;
  /// Finds the stream without images, or without new ones, for the longest time.
  void judge(tracking::SideStatus& status) const;

  const CamerasSetup setup_;
  const std::vector<std::string> addresses_;  ///< one (both eyes in one image) or two
  const SessionClock session_;
  SampleQueue& queue_;
  std::vector<std::unique_ptr<VideoStream>> first_;  ///< opened by the constructor; null: a network stream
  bool files_ = false;                               ///< all streams are video files
  std::atomic<bool> quit_{false};

  mutable std::mutex mutex_;  ///< protects the members below
  FramePairer pairer_;
  std::optional<double> newest_pair_;  ///< its time on the session's clock [s]
  tracking::SideStatus status_;
  struct Newest {
    Clock::time_point image, change;  ///< arrival of the newest image, and of the newest that was not frozen
  };
  std::array<Newest, 2> newest_;                    ///< by stream
  std::array<std::string, 2> reasons_;              ///< why nothing comes from a stream; empty: not known
  std::array<std::optional<Backlog>, 2> backlogs_;  ///< of network streams
  ImageClock clock_;
  ClockAgreement with_motors_, with_computer_;              ///< of the stamps of the images
  std::optional<std::chrono::nanoseconds> computer_since_;  ///< beginning of this computer's steady clock
                                                            ///< since 1970; none: no stamp so far
  int computer_steps_ = 0;                                  ///< of this computer's time
  const Clock::time_point start_ = Clock::now();

  std::vector<std::thread> threads_;
};

}  // namespace capstan::live
