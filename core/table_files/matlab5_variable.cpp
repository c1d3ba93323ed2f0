#include "core/table_files/matlab5_variable.h"

#include <algorithm>
#include <cstring>

namespace capstan::table_files {
namespace {

constexpr std::uint32_t kMostDims = 32;
constexpr std::uint32_t kLongestName = 4096;       ///< bytes; names of columns have few
constexpr std::uint32_t kLongestNames = 1U << 20;  ///< bytes of the names of all fields
constexpr std::uint32_t kComplex = 0x0800;
constexpr std::size_t kPieceNumbers = 8192;  ///< numbers that are read at once

std::uint32_t padded(std::uint32_t size) { return (8 - size % 8) % 8; }

}  // namespace

template <class T>
T MatlabReader::number() {
  std::array<char, sizeof(T)> bytes;
  bytes_.read(bytes.data(), bytes.size());
  if (swap_) std::reverse(bytes.begin(), bytes.end());
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

MatlabTag MatlabReader::tag() {
  const auto first = number<std::uint32_t>();
  const std::uint32_t small = first >> 16U;  // up to four bytes of data are within the tag
  if (small > 4) damaged();
  if (small > 0) return {first & 0xFFFFU, small, 4 - small};
  const auto size = number<std::uint32_t>();
  return {first, size, first == kMiCompressed || first == kMiMatrix ? 0 : padded(size)};
}

std::string MatlabReader::text(std::uint32_t longest) {
  const MatlabTag tag = this->tag();
  if (tag.size > longest) damaged();
  std::string text(tag.size, '\0');
  bytes_.read(text.data(), text.size());
  bytes_.skip(tag.padding);
  return text;
}

MatlabVariable MatlabReader::variable(std::uint64_t size) {
  MatlabVariable variable;
  variable.end = bytes_.position() + size;
  if (size == 0) return variable;  // an empty array, as fields may be
  const MatlabTag flags = tag();
  if (flags.type != kMiUint32 || flags.size != 8) damaged();
  const auto word = number<std::uint32_t>();
  bytes_.skip(4);
  variable.array_class = word & 0xFFU;
  variable.complex = (word & kComplex) != 0;
  const MatlabTag dims = tag();
  if (dims.type != kMiInt32 || dims.size % 4 != 0 || dims.size / 4 > kMostDims) damaged();
  for (std::uint32_t i = 0; i < dims.size / 4; ++i) variable.dims.push_back(number<std::uint32_t>());
  bytes_.skip(dims.padding);
  variable.name = text(kLongestName);
  if (bytes_.position() > variable.end) damaged();
  return variable;
}

template <class T>
void MatlabReader::append(std::size_t count, std::vector<double>& values) {
  std::vector<char> piece;
  while (count > 0) {
    const std::size_t now = std::min(count, kPieceNumbers);
    piece.resize(now * sizeof(T));
    bytes_.read(piece.data(), piece.size());
    for (std::size_t i = 0; i < now; ++i) {
      char* const begin = piece.data() + i * sizeof(T);
      if (swap_) std::reverse(begin, begin + sizeof(T));
      T value;
      std::memcpy(&value, begin, sizeof value);
      values.push_back(static_cast<double>(value));
    }
    count -= now;
  }
}

void MatlabReader::numbers(std::size_t count, std::vector<double>& values) {
  const MatlabTag tag = this->tag();
  const auto read = [&]<class T>(T) {
    if (tag.size != count * sizeof(T)) damaged();
    append<T>(count, values);
  };
  switch (tag.type) {
    case kMiInt8:
      return read(std::int8_t{});
    case kMiUint8:
      return read(std::uint8_t{});
    case kMiInt16:
      return read(std::int16_t{});
    case kMiUint16:
      return read(std::uint16_t{});
    case kMiInt32:
      return read(std::int32_t{});
    case kMiUint32:
      return read(std::uint32_t{});
    case kMiSingle:
      return read(float{});
    case kMiDouble:
      return read(double{});
    case kMiInt64:
      return read(std::int64_t{});
    case kMiUint64:
      return read(std::uint64_t{});
    default:
      damaged();
  }
}

std::vector<std::string> MatlabReader::fieldNames() {
  const MatlabTag length_tag = tag();
  if (length_tag.type != kMiInt32 || length_tag.size != 4) damaged();
  const auto length = number<std::uint32_t>();
  bytes_.skip(length_tag.padding);
  const std::string all = text(kLongestNames);
  if (length == 0 || all.size() % length != 0) damaged();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size(); i += length) names.emplace_back(all.substr(i, length).c_str());
  return names;
}

void MatlabReader::leave(const MatlabVariable& variable) {
  if (bytes_.position() > variable.end) damaged();
  bytes_.skip(variable.end - bytes_.position());
}

}  // namespace capstan::table_files
