#include "core/ros1/bag_export.h"

#include <fmt/format.h>
#include <rosbag/bag.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/ros1/raw_message.h"
#include "core/ros1/sample_messages.h"
#include "core/ros1/stamp.h"
#include "core/tracking/arrival.h"

namespace capstan::ros1 {
namespace {

ros::Time timeOf(std::int64_t nanoseconds) {
  return {static_cast<std::uint32_t>(nanoseconds / kSecond),
          static_cast<std::uint32_t>(nanoseconds % kSecond)};
}

/// ROS time of a time of the session [ns].
std::int64_t stampOf(double t, int epoch) {
  const std::int64_t stamp = epoch * kSecond + nanosecondsOf(t);
  constexpr double kLast = 4294967295.0;  // [s]
  if (!(std::abs(t) < kLast) || stamp <= 0 || stamp / kSecond > static_cast<std::int64_t>(kLast))
    throw base::InputError({{},
                            0,
                            "t",
                            fmt::format("{}", t),
                            "is a time that ROS cannot state",
                            "Subtract a constant from the times of the recording"});
  return stamp;
}

void write(rosbag::Bag& bag, const OutMessage& message, std::int64_t time) {
  bag.write(message.topic, timeOf(time), RawMessage{*message.type, message.bytes});
}

void count(BagReport& report, const tracking::Sample& sample) {
  report.motors += std::holds_alternative<tracking::MotorSample>(sample);
  report.joints += std::holds_alternative<tracking::JointSample>(sample);
  report.tips += std::holds_alternative<tracking::TipSample>(sample);
  if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample))
    report.images += !frame->left.empty() + !frame->right.empty();
}

double timeOf(const tracking::Sample& sample) {
  return std::visit([](const auto& one) { return one.t; }, sample);
}

}  // namespace

BagReport exportBag(tracking::Source& source, const std::filesystem::path& path, int epoch,
                    base::Progress* progress) {
  const tracking::SourceInfo& info = source.info();
  epoch = std::max(epoch, 1 + static_cast<int>(std::ceil(std::max(0.0, -info.begin))));
  const SampleMessages messages(info);
  base::PartFile part(path);
  BagReport report;
  try {
    rosbag::Bag bag;
    bag.open(part.path().string(), rosbag::bagmode::Write);
    tracking::Sample sample;
    bool first = true;
    while (source.next(sample)) {
      const std::int64_t time = stampOf(tracking::arrivalOf(sample), epoch);
      if (std::exchange(first, false)) write(bag, messages.session(epoch), time);
      for (const OutMessage& message : messages.of(sample, stampOf(timeOf(sample), epoch)))
        write(bag, message, time);
      count(report, sample);
      if (!progress || report.motors % 256 != 0) continue;
      if (progress->cancelled()) return report;
      if (info.duration > 0.0)
        progress->report(std::clamp((timeOf(sample) - info.begin) / info.duration, 0.0, 1.0),
                         "writing the bag");
    }
    bag.close();
  } catch (const rosbag::BagException& error) {
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            fmt::format("cannot be written: {}", error.what()),
                            "Check the folder, its permissions and the space on the disk"});
  }
  part.commit();
  return report;
}

}  // namespace capstan::ros1
