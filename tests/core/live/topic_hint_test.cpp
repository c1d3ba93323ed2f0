#include "core/live/topic_hint.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/error.h"
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

/// An address that ROS itself would end the program for.
TEST(TopicHint, AnAddressOfAMasterHasHostAndPort) {
  const char* const before = std::getenv("ROS_MASTER_URI");
  const std::string kept = before ? before : "";
  const auto isFine = [](const char* uri) {
    ::setenv("ROS_MASTER_URI", uri, 1);
    try {
      ros1::checkMasterUri();
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().key, "ROS_MASTER_URI");
      EXPECT_EQ(error.fault().value, uri);
      return false;
    }
    return true;
  };
  for (const char* uri : {"http://localhost:11311", "http://10.0.0.2:11311/", ""})
    EXPECT_TRUE(isFine(uri)) << uri;
  for (const char* uri : {"localhost:11311", "http://localhost", "http://:11311", "http://a:b", "http://a:0",
                          "http://a:11311x", "http://a:99999"})
    EXPECT_FALSE(isFine(uri)) << uri;
  before ? ::setenv("ROS_MASTER_URI", kept.c_str(), 1) : ::unsetenv("ROS_MASTER_URI");
}

TEST(TopicHint, SaysWhereThereIsNone) {
  EXPECT_EQ(motorsHint("/arm", std::nullopt), "no ROS master answers at http://127.0.0.1:11311");
  EXPECT_EQ(motorsHint("/arm", Topics{{{"/rosout", "rosgraph_msgs/Log"}}}),
            "nobody publishes /arm; no topic at http://127.0.0.1:11311 carries motors");
}

}  // namespace
}  // namespace capstan::live
