#include "core/live/topic_hint.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/edit_distance.h"
#include "core/ros1/master_topics.h"

namespace capstan::live {

std::string hintForTopic(const std::string& topic, bool (*fits)(const std::string& type),
                         const std::string& what, const std::optional<std::vector<ros1::TopicType>>& present,
                         const std::string& master) {
  if (!present) return fmt::format("no ROS master answers at {}", master);
  const auto published = std::ranges::find(*present, topic, &ros1::TopicType::topic);
  if (published != present->end() && fits(published->type)) return {};
  const std::string reason =
      published == present->end()
          ? fmt::format("nobody publishes {}", topic)
          : fmt::format("{} is of type {}, which carries no {}", topic, published->type, what);
  const ros1::TopicType* nearest = nullptr;
  const auto distance = [&](const ros1::TopicType& one) { return base::editDistance(topic, one.topic); };
  for (const ros1::TopicType& one : *present)
    if (fits(one.type) && (!nearest || distance(one) < distance(*nearest))) nearest = &one;
  return nearest ? fmt::format("{}; the nearest topic with {} is {}", reason, what, nearest->topic)
                 : fmt::format("{}; no topic at {} carries {}", reason, master, what);
}

std::optional<std::string> TopicHint::ask() {
  if (Clock::now() < next_) return {};
  const std::string master = ros1::masterUri();
  std::string hint = hintForTopic(topic_, fits_, what_, ros1::topicsAtMaster(master, kPatience), master);
  next_ = Clock::now() + kPeriod;
  return hint;
}

}  // namespace capstan::live
