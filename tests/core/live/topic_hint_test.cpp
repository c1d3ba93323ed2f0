#include "core/live/topic_hint.h"

#include <gtest/gtest.h>

#include "core/ros1/bag_topics.h"
#include "core/ros1/master_topics.h"

namespace capstan::live {
namespace {

constexpr const char* kMaster = "http://127.0.0.1:11311";
using Topics = std::optional<std::vector<ros1::TopicType>>;

std::string motorsHint(const std::string& topic, const Topics& present) {
  return ros1::hintForTopic(topic, ros1::carriesMotors, "motors", present, kMaster);
}

TEST(TopicHint, NamesTheNearestTopicOfTheSameKind) {
  const Topics present = {{{"/PSM1/actuators/measured_js", "sensor_msgs/JointState"},
                           {"/PSM2/actuators/measured_js", "sensor_msgs/JointState"},
                           {"/PSM1/actuator/measured_js", "sensor_msgs/Image"},
                           {"/stereo/left/image_raw", "sensor_msgs/Image"}}};
  EXPECT_EQ(motorsHint("/PSM1/actuators/measured_js", present), "");
  EXPECT_EQ(motorsHint("/PSM2/actuator/measured_js", present),
            "nobody publishes /PSM2/actuator/measured_js; the nearest topic with motors is "
            "/PSM2/actuators/measured_js");
  EXPECT_EQ(motorsHint("/stereo/left/image_raw", present).substr(0, 76),
            "/stereo/left/image_raw is of type sensor_msgs/Image, which carries no motors");
  EXPECT_EQ(ros1::hintForTopic("/stereo/left/image", ros1::carriesImages, "images", present, kMaster),
            "nobody publishes /stereo/left/image; the nearest topic with images is /stereo/left/image_raw");
}

TEST(TopicHint, SaysWhereThereIsNone) {
  EXPECT_EQ(motorsHint("/arm", std::nullopt), "no ROS master answers at http://127.0.0.1:11311");
  EXPECT_EQ(motorsHint("/arm", Topics{{{"/rosout", "rosgraph_msgs/Log"}}}),
            "nobody publishes /arm; no topic at http://127.0.0.1:11311 carries motors");
}

}  // namespace
}  // namespace capstan::live
