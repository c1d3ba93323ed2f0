#pragma once

#include <deque>
#include <optional>

#include "core/live/cameras/frame_pairer.h"
#include "core/ros1/bag_file.h"
#include "core/ros1/bag_topics.h"
#include "core/ros1/joint_message.h"
#include "core/ros1/session_text.h"
#include "core/tracking/source.h"

namespace capstan::ros1 {

/// A bag as a recording; see openBag().
class BagReader final : public tracking::Source {
 public:
  BagReader(const std::filesystem::path& path, const robot::Description& robot, const BagTopics& topics);

  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override;
  void block(bool left, bool right) override { blocked_ = {left, right}; }

 private:
  void readFacts(const robot::Description& robot);
  void readMotorBegin();
  void readCalibration();
  std::vector<std::string> sampleTopics() const;
  void readGroup();
  void take(const BagMessage& message);
  void takeMotors(const BagMessage& message, double arrival);
  void takeImage(const BagMessage& message, int side, double arrival);
  double timeOf(std::int64_t stamp, double arrival) const;

  const std::filesystem::path path_;
  BagFile file_;
  BagTopics topics_;
  tracking::SourceInfo info_;
  bool exact_ = false;  ///< exportBag() wrote the bag
  std::int64_t origin_ = 0,
               arrival_origin_ = 0;  ///< stamp and time of recording at the session's time 0 [ns]
  std::optional<RavenStateLayout> raven_;
  std::optional<robot::RavenSoftware> software_;
  live::FramePairer pairer_;
  std::optional<tracking::StereoFrame> images_;  ///< of the group that is read
  std::optional<BagMessage> ahead_;
  std::deque<tracking::Sample> samples_;
  std::array<bool, 2> blocked_{};
};

}  // namespace capstan::ros1
