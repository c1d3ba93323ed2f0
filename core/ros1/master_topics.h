#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// Address of the ROS master: the environment variable ROS_MASTER_URI, else "http://localhost:11311".
std::string masterUri();
/// Throws base::InputError where masterUri() is not http://HOST:PORT: ROS would end this program.
void checkMasterUri();
/// Throws base::InputError that no master answers at masterUri().
[[noreturn]] void refuseWithoutMaster();

/// Topics that somebody publishes at the master `uri` ("http://HOST:PORT"), in order of their names; nothing
/// if no master answers there within `patience` for the connection and as much for the answer. The master's
/// function getPublishedTopics (XML-RPC); this program becomes no node, so that it listens nowhere.
std::optional<std::vector<TopicType>> topicsAtMaster(const std::string& uri,
                                                     std::chrono::milliseconds patience);

/// Topics in the answer of getPublishedTopics: [1, text, [[topic, type], …]] as XML. Nothing for another
/// text.
std::optional<std::vector<TopicType>> topicsOfAnswer(const std::string& xml);

/// Why no message of a ROS topic comes, by what the master knows: `present` are the topics that somebody
/// publishes, nothing if no master answers at `master`; `fits`: the types that are wanted, `what`: what they
/// carry. Names the topic of such a type whose name is nearest. Empty: somebody publishes it.
std::string hintForTopic(const std::string& topic, bool (*fits)(const std::string& type),
                         const std::string& what, const std::optional<std::vector<TopicType>>& present,
                         const std::string& master);
/// The same by asking the master at masterUri(), with a patience of 0.7 s.
std::string hintFromMaster(const std::string& topic, bool (*fits)(const std::string& type),
                           const std::string& what);

}  // namespace capstan::ros1
