#include "core/ros1/master_topics.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "core/base/edit_distance.h"
#include "core/base/error.h"

namespace capstan::ros1 {
namespace {

constexpr const char* kRequest =
    "<?xml version=\"1.0\"?><methodCall><methodName>getPublishedTopics</methodName><params>"
    "<param><value><string>/capstan</string></value></param>"
    "<param><value><string></string></value></param></params></methodCall>";

/// Texts of the values that contain no other value, in order.
std::vector<std::string> leavesOf(const std::string& xml) {
  std::vector<std::string> leaves;
  std::string opened;  // tag just before the text; empty: a closing one
  std::size_t text = 0;
  for (std::size_t begin = xml.find('<'); begin != std::string::npos; begin = xml.find('<', text)) {
    const std::size_t end = xml.find('>', begin);
    if (end == std::string::npos) break;
    const std::string tag = xml.substr(begin + 1, end - begin - 1);
    const bool value = opened == "string" || opened == "int" || opened == "i4" || opened == "value";
    if (value && tag == "/" + opened) leaves.push_back(xml.substr(text, begin - text));
    opened = tag.starts_with('/') ? std::string() : tag;
    text = end + 1;
  }
  return leaves;
}

}  // namespace

std::string masterUri() {
  const char* uri = std::getenv("ROS_MASTER_URI");
  return uri != nullptr && *uri != '\0' ? uri : "http://localhost:11311";
}

void checkMasterUri() {
  constexpr std::string_view kScheme = "http://";
  const std::string uri = masterUri();
  const std::size_t colon = uri.rfind(':');
  std::uint16_t port = 0;
  const bool named = uri.starts_with(kScheme) && colon != std::string::npos && colon > kScheme.size();
  const char *begin = named ? uri.data() + colon + 1 : nullptr, *end = uri.data() + uri.size();
  if (named && end[-1] == '/') --end;
  if (named)
    if (const auto [last, fault] = std::from_chars(begin, end, port);
        fault == std::errc() && last == end && port > 0)
      return;
  throw base::InputError(
      {{}, 0, "ROS_MASTER_URI", uri, "is no address of a ROS master", "Set it as in http://localhost:11311"});
}

void refuseWithoutMaster() {
  throw base::InputError({masterUri(),
                          0,
                          {},
                          {},
                          "is the address of no ROS master that answers",
                          "Start one with roscore, or set ROS_MASTER_URI"});
}

std::optional<std::vector<TopicType>> topicsOfAnswer(const std::string& xml) {
  const std::vector<std::string> leaves = leavesOf(xml);
  if (xml.find("<methodResponse>") == std::string::npos || leaves.size() < 2 || leaves[0] != "1" ||
      leaves.size() % 2 != 0)
    return {};
  std::vector<TopicType> topics;
  for (std::size_t k = 2; k < leaves.size(); k += 2) topics.push_back({leaves[k], leaves[k + 1]});
  std::ranges::sort(topics, {}, &TopicType::topic);
  return topics;
}

std::optional<std::vector<TopicType>> topicsAtMaster(const std::string& uri,
                                                     std::chrono::milliseconds patience) {
  std::string address = uri;
  while (address.ends_with('/')) address.pop_back();
  if (!address.starts_with("http://")) return {};
  httplib::Client master(address);
  if (!master.is_valid()) return {};
  master.set_connection_timeout(patience);
  master.set_read_timeout(patience);
  master.set_write_timeout(patience);
  const auto answer = master.Post("/RPC2", kRequest, "text/xml");
  if (!answer || answer->status != 200) return {};
  return topicsOfAnswer(answer->body);
}

std::string hintForTopic(const std::string& topic, bool (*fits)(const std::string& type),
                         const std::string& what, const std::optional<std::vector<TopicType>>& present,
                         const std::string& master) {
  if (!present) return fmt::format("no ROS master answers at {}", master);
  const auto published = std::ranges::find(*present, topic, &TopicType::topic);
  if (published != present->end() && fits(published->type)) return {};
  const std::string reason =
      published == present->end()
          ? fmt::format("nobody publishes {}", topic)
          : fmt::format("{} is of type {}, which carries no {}", topic, published->type, what);
  const TopicType* nearest = nullptr;
  const auto distance = [&](const TopicType& one) { return base::editDistance(topic, one.topic); };
  for (const TopicType& one : *present)
    if (fits(one.type) && (!nearest || distance(one) < distance(*nearest))) nearest = &one;
  return nearest ? fmt::format("{}; the nearest topic with {} is {}", reason, what, nearest->topic)
                 : fmt::format("{}; no topic at {} carries {}", reason, master, what);
}

std::string hintFromMaster(const std::string& topic, bool (*fits)(const std::string& type),
                           const std::string& what) {
  constexpr std::chrono::milliseconds kPatience{700};
  const std::string master = masterUri();
  return hintForTopic(topic, fits, what, topicsAtMaster(master, kPatience), master);
}

}  // namespace capstan::ros1
