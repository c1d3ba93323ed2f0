#include "core/ros1/bag_record.h"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "core/ros1/stamp.h"

namespace capstan::ros1 {

std::uint32_t u32At(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, partOf(bytes, at, sizeof value).data(), sizeof value);
  return value;
}

std::span<const std::uint8_t> partOf(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  if (at > bytes.size() || size > bytes.size() - at) throw std::runtime_error("a length exceeds the record");
  return bytes.subspan(at, size);
}

BagRecord::BagRecord(std::span<const std::uint8_t> header) {
  for (std::size_t at = 0; at < header.size();) {
    const std::uint32_t size = u32At(header, at);
    const auto part = partOf(header, at + 4, size);
    const auto equal = std::ranges::find(part, static_cast<std::uint8_t>('='));
    if (equal == part.end()) throw std::runtime_error("a field of a record has no name");
    fields_[std::string(part.begin(), equal)] = std::string(equal + 1, part.end());
    at += 4 + size;
  }
}

const std::string& BagRecord::field(const char* name) const {
  const auto found = fields_.find(name);
  if (found == fields_.end()) throw std::runtime_error(std::string("a record has no field ") + name);
  return found->second;
}

std::uint64_t BagRecord::number(const std::string& bytes, std::size_t length) {
  if (bytes.size() != length) throw std::runtime_error("a field of a record has a wrong length");
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), length);
  return value;
}

std::int64_t BagRecord::time(const char* name) const {
  const std::uint64_t value = u64(name);
  return static_cast<std::int64_t>(value & 0xffffffffU) * kSecond + static_cast<std::int64_t>(value >> 32U);
}

namespace {

Bytes fromBz2(const Bytes& stored, std::uint32_t size) {
  Bytes out(size);
  unsigned length = size;
  const int fault =
      BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(out.data()), &length,
                                 const_cast<char*>(reinterpret_cast<const char*>(stored.data())),
                                 static_cast<unsigned>(stored.size()), 0, 0);
  if (fault != BZ_OK || length != size) throw std::runtime_error("a chunk cannot be uncompressed (bz2)");
  return out;
}

Bytes fromLz4(const Bytes& stored, std::uint32_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)))
    throw std::runtime_error("LZ4 is not available");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, LZ4F_freeDecompressionContext);
  // A byte of the block format repeats at most 255 bytes (lz4.org): no memory for a size that is not stored.
  constexpr std::uint64_t kLargestRatio = 255;
  if (size > kLargestRatio * stored.size()) throw std::runtime_error("a chunk states a wrong size");
  Bytes out(size);
  std::size_t read = 0, written = 0;
  while (read < stored.size() && written < size) {
    std::size_t in = stored.size() - read, room = size - written;
    const std::size_t state =
        LZ4F_decompress(context, out.data() + written, &room, stored.data() + read, &in, nullptr);
    if (LZ4F_isError(state) || (in == 0 && room == 0)) break;
    read += in, written += room;
  }
  if (written != size) throw std::runtime_error("a chunk cannot be uncompressed (lz4)");
  return out;
}

}  // namespace

Bytes uncompressed(const Bytes& stored, const std::string& compression, std::uint32_t size) {
  if (compression == "none") return stored;
  if (compression == "bz2") return fromBz2(stored, size);
  if (compression == "lz4") return fromLz4(stored, size);
  throw std::runtime_error("a chunk has the compression " + compression);
}

}  // namespace capstan::ros1
