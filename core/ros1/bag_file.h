#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/ros1/bag_topics.h"
#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// One message of a bag.
struct BagMessage {
  std::int64_t time = 0;  ///< at which it was recorded [ns]
  std::string topic, type;
  Bytes bytes;
};

/// Reads a bag message by message, in order of the times of recording. Holds one chunk of the bag in memory.
class BagFile {
 public:
  /// Throws base::InputError with remedy for a file that is missing, no bag, of another version, without
  /// index, or damaged.
  explicit BagFile(const std::filesystem::path& path);
  ~BagFile();
  BagFile(BagFile&&) noexcept;

  std::vector<TopicType> topics() const;
  /// Definition of the messages on `topic`.
  std::string definitionOf(const std::string& topic) const;
  std::int64_t begin() const;  ///< time of the first message [ns]
  std::int64_t end() const;    ///< time of the last one [ns]

  /// Goes to the begin; next() then yields messages of these topics only.
  void choose(const std::vector<std::string>& topics);
  /// Nothing: all were read. Throws base::InputError that names the time of the damage.
  std::optional<BagMessage> next();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::ros1
