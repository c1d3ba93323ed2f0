// Compiled instead of the other sources where configure found no ROS 1.
#include "core/ros1/bag_export.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/no_ros.h"
#include "core/ros1/ros_topics.h"

namespace capstan::ros1 {

BagReport exportBag(tracking::Source&, const std::filesystem::path& path, int, base::Progress*) {
  throw withoutRos(path.string());
}

#define CAPSTAN_NO_ROS_MESSAGE(M)  \
  template <>                      \
  const MessageType& typeOf<M>() { \
    throw withoutRos("a topic");   \
  }                                \
  template <>                      \
  Bytes encode<M>(const M&) {      \
    throw withoutRos("a topic");   \
  }

CAPSTAN_NO_ROS_MESSAGE(JointState)
CAPSTAN_NO_ROS_MESSAGE(Image)
CAPSTAN_NO_ROS_MESSAGE(CompressedImage)
CAPSTAN_NO_ROS_MESSAGE(CameraInfo)
CAPSTAN_NO_ROS_MESSAGE(Text)
CAPSTAN_NO_ROS_MESSAGE(PointStamped)
CAPSTAN_NO_ROS_MESSAGE(PoseStamped)
CAPSTAN_NO_ROS_MESSAGE(PoseWithCovarianceStamped)

#undef CAPSTAN_NO_ROS_MESSAGE

class TopicReader::Impl {};
TopicReader::TopicReader(const std::string& topic, std::size_t) { throw withoutRos(topic); }
TopicReader::~TopicReader() = default;
std::optional<TopicMessage> TopicReader::next(std::chrono::milliseconds) { return {}; }
std::uint64_t TopicReader::lost() const { return 0; }
std::uint64_t TopicReader::connections() const { return 0; }
bool TopicReader::hasPublisher() const { return false; }

class TopicWriter::Impl {};
TopicWriter::TopicWriter(const std::string& topic, const MessageType&, bool) { throw withoutRos(topic); }
TopicWriter::~TopicWriter() = default;
void TopicWriter::publish(const Bytes&) {}
std::uint32_t TopicWriter::subscribers() const { return 0; }

bool isMasterThere() { return false; }
std::string masterAddress() { return {}; }
std::int64_t rosTimeNow() { return 0; }

}  // namespace capstan::ros1
