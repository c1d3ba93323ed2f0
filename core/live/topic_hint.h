#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/ros1/message_data.h"

namespace capstan::live {

/// Asks the master for the hint while nothing comes: kFirst after the begin, then every kPeriod.
class TopicHint {
 public:
  TopicHint(std::string topic, bool (*fits)(const std::string& type), std::string what)
      : topic_(std::move(topic)), fits_(fits), what_(std::move(what)) {}
  bool isDue() const { return Clock::now() >= next_; }
  /// The hint; nothing: it is not time to ask. Waits as hintFromMaster().
  std::optional<std::string> ask();

  static constexpr std::chrono::milliseconds kFirst{500}, kPeriod{3000};

 private:
  using Clock = std::chrono::steady_clock;
  std::string topic_;
  bool (*fits_)(const std::string&);
  std::string what_;
  Clock::time_point next_ = Clock::now() + kFirst;
};

}  // namespace capstan::live
