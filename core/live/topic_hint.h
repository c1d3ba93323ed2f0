#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/ros1/message_data.h"

namespace capstan::live {

/// Why no message of a ROS topic comes, by what the master knows: `present` are the topics that somebody
/// publishes, nothing if no master answers at `master`; `fits`: the types that are wanted, `what`: what they
/// carry. Names the topic of such a type whose name is nearest. Empty: somebody publishes it.
std::string hintForTopic(const std::string& topic, bool (*fits)(const std::string& type),
                         const std::string& what, const std::optional<std::vector<ros1::TopicType>>& present,
                         const std::string& master);

/// Asks the master for the hint while nothing comes: kFirst after the begin, then every kPeriod.
class TopicHint {
 public:
  TopicHint(std::string topic, bool (*fits)(const std::string& type), std::string what)
      : topic_(std::move(topic)), fits_(fits), what_(std::move(what)) {}
  /// The hint; nothing: it is not time to ask. Waits up to kPatience for the master.
  std::optional<std::string> ask();

  static constexpr std::chrono::milliseconds kFirst{500}, kPeriod{3000}, kPatience{700};

 private:
  using Clock = std::chrono::steady_clock;
  std::string topic_;
  bool (*fits_)(const std::string&);
  std::string what_;
  Clock::time_point next_ = Clock::now() + kFirst;
};

}  // namespace capstan::live
