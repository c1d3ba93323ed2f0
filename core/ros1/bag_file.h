#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/ros1/bag_record.h"
#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// One message of a bag.
struct BagMessage {
  std::int64_t time = 0;  ///< at which it was recorded [ns]
  std::string topic, type;
  Bytes bytes;
};

/// Reads a bag of version 2.0 message by message, in order of the times of recording. Holds its index and one
/// chunk in memory. All lengths in the file are checked, so that a damaged file ends with an error.
/// Format: wiki.ros.org/Bags/Format/2.0.
class BagFile {
 public:
  /// Throws base::InputError with remedy for a file that is missing, no bag, of another version, without
  /// index, or damaged.
  explicit BagFile(const std::filesystem::path& path);

  std::vector<TopicType> topics() const;
  /// Definition of the messages on `topic`.
  std::string definitionOf(const std::string& topic) const;
  std::int64_t begin() const { return begin_; }  ///< time of the first message [ns]
  std::int64_t end() const { return end_; }      ///< time of the last one [ns]

  /// Goes to the begin; next() then yields messages of these topics only.
  void choose(const std::vector<std::string>& topics);
  /// Nothing: all were read. Throws base::InputError that names the time of the damage.
  std::optional<BagMessage> next();

  static constexpr std::uint32_t kLargestChunk = 1U << 28;  ///< uncompressed [bytes]; rosbag makes 768 KiB

 private:
  struct Connection {
    std::string topic, type, definition;
  };
  struct Entry {
    std::int64_t time = 0;
    std::uint32_t chunk = 0, offset = 0;
  };
  struct Chunk {
    std::uint64_t at = 0;  ///< of its data in the file
    std::uint32_t stored = 0, size = 0;
    std::string compression;
  };
  struct Due {
    Entry entry;
    std::uint32_t connection = 0;
  };
  void index();
  void takeRecord(const BagRecord& record);
  void takeIndex(const BagRecord& record);
  const Bytes& chunk(std::uint32_t number);
  [[noreturn]] void refuse(const std::string& reason) const;
  /// Does `work`; a fault of the format becomes an error of the file.
  template <class Work>
  void guarded(Work&& work) const;

  const std::filesystem::path path_;
  mutable std::ifstream in_;
  std::uint64_t size_ = 0;  ///< of the file [bytes]
  std::map<std::uint32_t, Connection> connections_;
  std::map<std::uint32_t, std::vector<Entry>> entries_;  ///< by connection
  std::vector<Chunk> chunks_;
  std::vector<Due> due_;
  std::size_t next_ = 0;
  std::optional<std::uint32_t> loaded_;
  Bytes chunk_;
  std::int64_t begin_ = 0, end_ = 0, time_ = 0;
};

}  // namespace capstan::ros1
