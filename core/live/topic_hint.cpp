#include "core/live/topic_hint.h"

#include "core/ros1/master_topics.h"

namespace capstan::live {

std::optional<std::string> TopicHint::ask() {
  if (!isDue()) return {};
  std::string hint = ros1::hintFromMaster(topic_, fits_, what_);
  next_ = Clock::now() + kPeriod;
  return hint;
}

}  // namespace capstan::live
