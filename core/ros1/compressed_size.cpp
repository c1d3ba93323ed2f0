#include "core/ros1/compressed_size.h"

#include <algorithm>
#include <array>

namespace capstan::ros1 {
namespace {

constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::uint32_t bigEndian(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8U | bytes[at + i];
  return value;
}

/// Whether a JPEG marker begins a frame: SOF0 to SOF15 without DHT, JPG and DAC.
bool isFrame(std::uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

std::optional<ImageSize> jpegSizeOf(std::span<const std::uint8_t> bytes) {
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (bytes[at] != 0xff) return {};
    const std::uint8_t marker = bytes[at + 1];
    if (isFrame(marker)) return ImageSize{bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
    if (marker == 0xff)
      ++at;  // a fill byte
    else if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8))
      at += 2;  // without a length
    else
      at += 2 + bigEndian(bytes, at + 2, 2);
  }
  return {};
}

}  // namespace

std::optional<ImageSize> compressedSizeOf(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kPngSize = 24;
  if (bytes.size() >= kPngSize && std::ranges::equal(bytes.first(kPng.size()), kPng))
    return ImageSize{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
  if (bytes.size() >= 2 && bytes[0] == 0xff && bytes[1] == 0xd8) return jpegSizeOf(bytes);
  return {};
}

}  // namespace capstan::ros1
