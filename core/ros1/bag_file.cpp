#include "core/ros1/bag_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "core/base/error.h"
#include "core/ros1/stamp.h"

namespace capstan::ros1 {
namespace {

constexpr std::string_view kBegin = "#ROSBAG V", kVersion = "2.0\n";
constexpr std::uint32_t kLongestHeader = 1U << 20;

std::string reindex(const std::filesystem::path& path) {
  return fmt::format("Copy it again, or save the readable part with: rosbag reindex {}",
                     path.filename().string());
}

/// Reads the file from one place on, within its size.
class Cursor {
 public:
  Cursor(std::istream& in, std::uint64_t at, std::uint64_t size) : in_(in), at_(at), size_(size) {}
  std::uint64_t at() const { return at_; }
  std::uint64_t left() const { return size_ - at_; }

  Bytes bytes(std::uint64_t count) {
    need(count);
    Bytes bytes(count);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at_));
    in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
    if (static_cast<std::uint64_t>(in_.gcount()) != count) throw std::runtime_error("it cannot be read");
    at_ += count;
    return bytes;
  }
  std::uint32_t u32() { return u32At(bytes(4), 0); }
  void skip(std::uint64_t count) {
    need(count);
    at_ += count;
  }

 private:
  void need(std::uint64_t count) const {
    if (count > left()) throw std::runtime_error("the file ends in a record");
  }

  std::istream& in_;
  std::uint64_t at_, size_;
};

BagRecord recordAt(Cursor& cursor) {
  const std::uint32_t length = cursor.u32();
  if (length > kLongestHeader) throw std::runtime_error("a record has too long a header");
  BagRecord record(cursor.bytes(length));
  record.data_size = cursor.u32();
  record.data_at = cursor.at();
  const bool skipped = record.kind() == BagRecord::kChunk || record.kind() == BagRecord::kBag;
  if (skipped)
    cursor.skip(record.data_size);
  else
    record.data = cursor.bytes(record.data_size);
  return record;
}

}  // namespace

void BagFile::refuse(const std::string& reason) const {
  throw base::InputError({path_.string(), 0, {}, {}, reason, reindex(path_)});
}

template <class Work>
void BagFile::guarded(Work&& work) const {
  try {
    work();
  } catch (const base::InputError&) {
    throw;
  } catch (const std::exception& error) {
    const double since = secondsOf(time_ - begin_);
    refuse(time_ > begin_ ? fmt::format("is damaged {:.3f} s after its begin: {}", since, error.what())
                          : fmt::format("is damaged: {}", error.what()));
  }
}

BagFile::BagFile(const std::filesystem::path& path) : path_(path) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault))
    throw base::InputError({path.string(), 0, {}, {}, "is not a file", "Check the path"});
  size_ = std::filesystem::file_size(path, fault);
  in_.open(path, std::ios::binary);
  guarded([this] { index(); });
}

void BagFile::index() {
  Cursor cursor(in_, 0, size_);
  const Bytes begin = cursor.bytes(kBegin.size() + kVersion.size());
  const std::string line(begin.begin(), begin.end());
  if (!line.starts_with(kBegin)) refuse("is no bag");
  if (!line.ends_with(kVersion))
    throw base::InputError({path_.string(),
                            0,
                            {},
                            line.substr(kBegin.size(), 3),
                            "is a bag of another version than 2.0",
                            "Convert it with: rosbag fix"});
  const BagRecord bag = recordAt(cursor);
  if (bag.kind() != BagRecord::kBag) throw std::runtime_error("its first record is no bag header");
  if (bag.u64("index_pos") == 0)
    throw base::InputError({path_.string(),
                            0,
                            {},
                            {},
                            "has no index, because the program that recorded it was ended by force",
                            fmt::format("Make one with: rosbag reindex {}", path_.filename().string())});
  while (cursor.left() > 0) takeRecord(recordAt(cursor));
  if (chunks_.size() != bag.u32("chunk_count")) throw std::runtime_error("chunks are missing");
  bool first = true;
  for (const auto& [connection, entries] : entries_) {
    if (!connections_.contains(connection)) throw std::runtime_error("messages of an unknown topic");
    for (const Entry& entry : entries) {
      begin_ = first ? entry.time : std::min(begin_, entry.time);
      end_ = first ? entry.time : std::max(end_, entry.time);
      first = false;
    }
  }
  time_ = begin_;
}

void BagFile::takeRecord(const BagRecord& record) {
  if (record.kind() == BagRecord::kChunk) {
    const std::uint32_t size = record.u32("size");
    if (size > kLargestChunk) throw std::runtime_error("a chunk is too large");
    chunks_.push_back({record.data_at, record.data_size, size, record.text("compression")});
  } else if (record.kind() == BagRecord::kIndex) {
    takeIndex(record);
  } else if (record.kind() == BagRecord::kConnection) {
    const BagRecord facts(record.data);
    connections_[record.u32("conn")] = {record.text("topic"), facts.text("type"),
                                        facts.text("message_definition")};
  }
}

void BagFile::takeIndex(const BagRecord& record) {
  constexpr std::size_t kEntry = 12;
  if (chunks_.empty()) throw std::runtime_error("an index precedes its chunk");
  const std::uint32_t count = record.u32("count");
  if (record.u32("ver") != 1 || record.data.size() != kEntry * static_cast<std::size_t>(count))
    throw std::runtime_error("an index has a wrong length");
  std::vector<Entry>& entries = entries_[record.u32("conn")];
  for (std::size_t at = 0; at < record.data.size(); at += kEntry)
    entries.push_back(
        {static_cast<std::int64_t>(u32At(record.data, at)) * kSecond + u32At(record.data, at + 4),
         static_cast<std::uint32_t>(chunks_.size() - 1), u32At(record.data, at + 8)});
}

std::vector<TopicType> BagFile::topics() const {
  std::vector<TopicType> found;
  std::set<std::string> known;
  for (const auto& [id, one] : connections_)
    if (known.insert(one.topic).second) found.push_back({one.topic, one.type});
  return found;
}

std::string BagFile::definitionOf(const std::string& topic) const {
  for (const auto& [id, one] : connections_)
    if (one.topic == topic) return one.definition;
  return {};
}

void BagFile::choose(const std::vector<std::string>& topics) {
  due_.clear();
  next_ = 0;
  time_ = begin_;
  for (const auto& [id, entries] : entries_)
    if (std::ranges::find(topics, connections_.at(id).topic) != topics.end())
      for (const Entry& entry : entries) due_.push_back({entry, id});
  std::ranges::stable_sort(
      due_, {}, [](const Due& due) { return std::tuple(due.entry.time, due.entry.chunk, due.entry.offset); });
}

const Bytes& BagFile::chunk(std::uint32_t number) {
  if (loaded_ == number) return chunk_;
  const Chunk& one = chunks_.at(number);
  loaded_.reset();
  chunk_ = Bytes();  // one at a time in memory
  chunk_ = uncompressed(Cursor(in_, one.at, size_).bytes(one.stored), one.compression, one.size);
  loaded_ = number;
  return chunk_;
}

std::optional<BagMessage> BagFile::next() {
  if (next_ == due_.size()) return {};
  BagMessage message;
  guarded([&] {
    const Due& due = due_[next_];
    const Bytes& bytes = chunk(due.entry.chunk);
    const std::size_t at = due.entry.offset;
    const std::uint32_t length = u32At(bytes, at);
    const BagRecord record(partOf(bytes, at + 4, length));
    if (record.kind() != BagRecord::kMessage || record.u32("conn") != due.connection)
      throw std::runtime_error("the index points to another record");
    const auto data = partOf(bytes, at + 8 + length, u32At(bytes, at + 4 + length));
    time_ = due.entry.time;
    const Connection& connection = connections_.at(due.connection);
    message = {time_, connection.topic, connection.type, Bytes(data.begin(), data.end())};
    ++next_;
  });
  return message;
}

}  // namespace capstan::ros1
