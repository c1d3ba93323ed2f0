#pragma once

#include <chrono>
#include <map>
#include <string>

#include "core/live/player.h"
#include "core/ros1/ros_topics.h"
#include "core/ros1/sample_messages.h"

namespace capstan::live {

/// Publishes a recording on ROS topics in real time, as a robot and its cameras would (ros1::ourTopics()).
/// Stamps are the ROS time of the begin plus the recording's time.
class RosPlayer {
 public:
  /// Throws base::InputError where no master answers.
  explicit RosPlayer(const tracking::SourceInfo& info);
  ~RosPlayer();

  /// Topics that are published, in words.
  std::string words() const;

  enum class Topics { kMotors, kImages };
  /// Waits up to `patience` until somebody subscribes to the motors, or to both cameras. False: nobody has.
  bool waitForSubscribers(Topics topics, std::chrono::milliseconds patience,
                          const base::Progress* progress) const;

  /// Publishes motors, joints and tips of `source`. A fault of a motor sample is that of its joints, too.
  PlayReport playRows(tracking::Source& source, const PlayClock& clock, const PlayOptions& options,
                      base::Progress* progress);
  /// Publishes the images of `source` at their times of arrival.
  ImagePlayReport playImages(tracking::Source& source, const PlayClock& clock, const PlayOptions& options,
                             const base::Progress* progress);

 private:
  void publish(const tracking::Sample& sample, std::int64_t stamp);
  bool hasSubscriber() const;  ///< the topic of motors
  void publishDamaged(const tracking::Sample& sample);

  ros1::SampleMessages messages_;
  std::map<std::string, ros1::TopicWriter> writers_;
};

}  // namespace capstan::live
