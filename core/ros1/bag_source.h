#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "core/robot/description.h"
#include "core/ros1/bag_topics.h"
#include "core/tracking/source.h"

namespace capstan::ros1 {

/// True if a file with these first bytes is a bag.
inline bool isBag(std::string_view first_bytes) { return first_bytes.starts_with("#ROSBAG V"); }

/// Opens a bag as a recording. Motor stamps minus the first one are the session's time; the times of
/// recording are the times of arrival. A bag that exportBag() wrote gives back the times, facts and order of
/// its session. `robot` is for bags without a robot. Throws base::InputError as BagFile and completeTopics(),
/// for images without calibration, for motors of which the first message is not of a three-joint arm, and
/// where this program was built without ROS.
std::unique_ptr<tracking::Source> openBag(const std::filesystem::path& path, const robot::Description& robot,
                                          const BagTopics& topics = {});

}  // namespace capstan::ros1
