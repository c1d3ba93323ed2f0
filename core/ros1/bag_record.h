#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// Header of a record of a bag: its fields by name.
class BagRecord {
 public:
  enum Kind : std::uint8_t {
    kMessage = 2,
    kBag = 3,
    kIndex = 4,
    kChunk = 5,
    kChunkInfo = 6,
    kConnection = 7
  };

  /// Throws std::runtime_error for bytes that are no fields.
  explicit BagRecord(std::span<const std::uint8_t> header);

  std::uint8_t kind() const { return static_cast<std::uint8_t>(number(field("op"), 1)); }
  /// Fields as text, number of 4 or 8 bytes, and time [ns]. Throw std::runtime_error where the field is
  /// missing or has another length.
  const std::string& text(const char* name) const { return field(name); }
  std::uint32_t u32(const char* name) const { return static_cast<std::uint32_t>(number(field(name), 4)); }
  std::uint64_t u64(const char* name) const { return number(field(name), 8); }
  std::int64_t time(const char* name) const;

  Bytes data;                 ///< that follows the header, where it was read
  std::uint64_t data_at = 0;  ///< of the data in the file
  std::uint32_t data_size = 0;

 private:
  const std::string& field(const char* name) const;
  static std::uint64_t number(const std::string& bytes, std::size_t length);

  std::map<std::string, std::string> fields_;
};

/// Little-endian number at `at`. Throws std::runtime_error if it ends after the bytes.
std::uint32_t u32At(std::span<const std::uint8_t> bytes, std::size_t at);
/// Part of the bytes. Throws std::runtime_error if it ends after them.
std::span<const std::uint8_t> partOf(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size);

/// The data of a chunk, uncompressed; `compression`: none, bz2 or lz4; `size`: uncompressed. Throws
/// std::runtime_error for another compression and for damaged data.
Bytes uncompressed(const Bytes& stored, const std::string& compression, std::uint32_t size);

}  // namespace capstan::ros1
