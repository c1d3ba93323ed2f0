#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/ros1/message_data.h"

/// Topics of a running ROS 1 system. This process becomes one node of it with the first object of this
/// header; the node listens for its peers, on loopback only if ROS_HOSTNAME is localhost or ROS_IP is
/// 127.0.0.1. A master that was restarted does not know the node: within kRegister, all its topics are
/// registered again. Functions throw base::InputError for a name that is no topic, where no master can be
/// named (ROS_MASTER_URI), and where this program was built without ROS.
///
/// This header and ros_topics.cpp are C++17: see message_data.h.
namespace capstan::ros1 {

/// Message that was received.
struct TopicMessage {
  std::chrono::steady_clock::time_point arrival;
  std::string type, definition;
  Bytes bytes;
  std::uint64_t lost = 0;  ///< messages that waited for too long between the one before and this one
};

/// Messages of one topic, in order of arrival. A reader that is behind loses the oldest ones.
class TopicReader {
 public:
  /// `capacity`: number of messages that wait.
  TopicReader(const std::string& topic, std::size_t capacity);
  ~TopicReader();

  /// Waits up to `wait` for a message.
  std::optional<TopicMessage> next(std::chrono::milliseconds wait);
  std::uint64_t lost() const;         ///< messages that waited for too long
  std::uint64_t connections() const;  ///< number of times that a publisher has connected
  bool hasPublisher() const;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

/// Publishes messages of one type on one topic.
class TopicWriter {
 public:
  /// `latched`: whoever subscribes gets the last message.
  TopicWriter(const std::string& topic, const MessageType& type, bool latched = false);
  ~TopicWriter();

  void publish(const Bytes& bytes);
  std::uint32_t subscribers() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a master answers.
bool isMasterThere();
/// Address of the master, as "http://127.0.0.1:11311".
std::string masterAddress();
/// ROS time now [ns].
std::int64_t rosTimeNow();

/// A new master knows all topics of this process after at most this time.
inline constexpr std::chrono::milliseconds kRegister{1000};

}  // namespace capstan::ros1
