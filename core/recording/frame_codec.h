#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

namespace capstan::recording {

/// Sizes of images that are stored: at least 2 × 2 and at most as many pixels as 8K video has [px].
inline constexpr std::int64_t kLongestSide = 16384, kMostPixels = 7680 * 4320;
inline constexpr bool isFrameSize(std::int64_t width, std::int64_t height) {
  return width >= 2 && height >= 2 && width <= kLongestSide && height <= kLongestSide &&
         width * height <= kMostPixels;
}

/// Parameters of a decoder besides the packet.
struct CodecParameters {
  std::string name;  ///< libavcodec's name
  int width = 0, height = 0;
  std::vector<std::uint8_t> extradata;
  std::uint32_t fourcc = 0;  ///< variant of the codec, first letter lowest
};

/// Lossless intra-only encoder for 8-bit BGR images of one size: each packet can be decoded alone. It runs on
/// the caller's thread.
class FrameEncoder {
 public:
  /// Size in pixels, at least 2×2. Throws std::runtime_error for sizes that cannot be encoded.
  FrameEncoder(int width, int height);
  ~FrameEncoder();
  FrameEncoder(FrameEncoder&&) noexcept;
  FrameEncoder& operator=(FrameEncoder&&) noexcept;

  const CodecParameters& parameters() const;
  /// Encodes `bgr` (8UC3, the encoder's size). The packet is valid until the next call.
  std::span<const std::uint8_t> encode(const cv::Mat& bgr);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

class FrameDecoder {
 public:
  /// Throws base::InputError (about `file`) for a codec that FrameEncoder does not write, or that this
  /// libavcodec lacks.
  FrameDecoder(const CodecParameters& parameters, const std::string& file);
  ~FrameDecoder();
  FrameDecoder(FrameDecoder&&) noexcept;
  FrameDecoder& operator=(FrameDecoder&&) noexcept;

  /// Decodes into `bgr`, whose memory is reused. False: the packet is damaged.
  bool decode(std::span<const std::uint8_t> packet, cv::Mat& bgr);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::recording
