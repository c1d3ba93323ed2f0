#include "core/live/topic_hint.h"

#include "core/ros1/master_topics.h"

namespace capstan::live {

std::optional<std::string> TopicHint::ask() {
  if (Clock::now() < next_) return {};
  const std::string master = ros1::masterUri();
  std::string hint =
      ros1::hintForTopic(topic_, fits_, what_, ros1::topicsAtMaster(master, kPatience), master);
  next_ = Clock::now() + kPeriod;
  return hint;
}

}  // namespace capstan::live
