#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/progress.h"
#include "core/tracking/source.h"

namespace capstan::ros1 {

/// Numbers of messages in a bag.
struct BagReport {
  std::int64_t motors = 0, joints = 0, tips = 0, images = 0;
};

/// Writes a recording as a bag on ourTopics() (resources/manual/ros.md). Stamps are `epoch` [s, ROS time]
/// plus the session's time, to the nanosecond; a message's time of recording is its time of arrival. A former
/// file stays until the new one is complete. Throws base::InputError where the file cannot be written, for
/// times that ROS cannot state, and where this program was built without ROS.
BagReport exportBag(tracking::Source& source, const std::filesystem::path& path, int epoch,
                    base::Progress* progress = nullptr);

}  // namespace capstan::ros1
