#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/ros1/bag_topics.h"
#include "core/ros1/message_data.h"
#include "core/tracking/source.h"

namespace capstan::ros1 {

/// A message to write to a bag or to publish.
struct OutMessage {
  std::string topic;
  const MessageType* type = nullptr;
  Bytes bytes;
};

/// Converts samples of a source to messages on ourTopics().
class SampleMessages {
 public:
  explicit SampleMessages(const tracking::SourceInfo& info);
  /// Topics with types that samples of the source may have.
  std::vector<std::pair<std::string, const MessageType*>> topics() const;
  /// Messages of `sample`; `stamp` [ns] is the ROS time of its measurement.
  std::vector<OutMessage> of(const tracking::Sample& sample, std::int64_t stamp) const;
  /// Camera_info of both cameras, at a stamp [ns]; none without cameras.
  std::vector<OutMessage> calibration(std::int64_t stamp) const;
  /// The message on kSessionTopic.
  OutMessage session(int epoch) const;

 private:
  void addImage(const cv::Mat& image, std::size_t side, std::int64_t stamp,
                std::vector<OutMessage>& out) const;

  const tracking::SourceInfo info_;
  const BagTopics topics_ = ourTopics();
  std::array<CameraInfo, 2> cameras_;
};

}  // namespace capstan::ros1
