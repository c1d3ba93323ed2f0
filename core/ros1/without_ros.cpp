// Compiled instead of the other sources where configure found no ROS 1.
#include "core/ros1/bag_export.h"
#include "core/ros1/bag_source.h"
#include "core/ros1/no_ros.h"

namespace capstan::ros1 {

std::unique_ptr<tracking::Source> openBag(const std::filesystem::path& path, const robot::Description&,
                                          const BagTopics&) {
  throw withoutRos(path.string());
}
BagReport exportBag(tracking::Source&, const std::filesystem::path& path, int, base::Progress*) {
  throw withoutRos(path.string());
}

}  // namespace capstan::ros1
