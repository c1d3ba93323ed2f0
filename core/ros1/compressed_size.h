#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace capstan::ros1 {

/// Width and height [px].
struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

/// Size that a JPEG or PNG image states, without decoding it; nothing for other bytes. JPEG: ISO/IEC 10918-1,
/// B.2; PNG: W3C, Portable Network Graphics, 11.2.2.
std::optional<ImageSize> compressedSizeOf(std::span<const std::uint8_t> bytes);

/// Whether images of this size are read: from 1 × 1 to as many pixels as 8K video has.
inline bool isImageSize(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t kLongest = 16384;
  constexpr std::uint64_t kMost = 7680 * 4320;
  return width > 0 && height > 0 && width <= kLongest && height <= kLongest &&
         static_cast<std::uint64_t>(width) * height <= kMost;
}

}  // namespace capstan::ros1
