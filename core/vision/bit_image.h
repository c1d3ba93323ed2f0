#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace capstan::vision {

/// Binary image with one bit per pixel and 64 pixels per word; bit 0 of word 0 is the leftmost pixel. Every
/// row has one guard word on each side (words −1 and words()), so that filters read neighbouring words
/// without bounds checks. Storage is fixed at construction; resize() only changes the used part.
class BitImage {
 public:
  BitImage(int max_width, int max_height);

  void resize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }
  int words() const { return words_; }
  std::uint64_t* row(int y) { return data_.data() + static_cast<std::size_t>(y) * stride() + 1; }
  const std::uint64_t* row(int y) const { return data_.data() + static_cast<std::size_t>(y) * stride() + 1; }
  bool at(int x, int y) const { return (row(y)[x >> 6] >> (x & 63)) & 1; }
  /// Mask of the bits of the last word that are pixels.
  std::uint64_t lastWordMask() const {
    return (width_ & 63) ? (std::uint64_t{1} << (width_ & 63)) - 1 : ~std::uint64_t{0};
  }
  /// Number of words of a row that filters read and write, a multiple of four.
  static std::size_t paddedWords(int words) {
    return (static_cast<std::size_t>(words) + 3) & ~std::size_t{3};
  }
  std::size_t paddedWords() const { return paddedWords(words_); }
  /// Whether any pixel in the rows first_row to last_row is set.
  bool anySet(int first_row, int last_row) const;
  /// Sets all bits of row y beyond the image, including the guard words, to `left` and `right`.
  void fillBeyond(int y, bool left, bool right);

 private:
  std::size_t stride() const { return paddedWords() + 2; }

  int width_ = 0, height_ = 0, words_ = 0;
  std::vector<std::uint64_t> data_;
};

/// Range [first, last] of the rows of an image that contain set pixels; empty when first > last.
struct RowSpan {
  int first = 0, last = -1;
  bool empty() const { return first > last; }
  RowSpan grown(int by, int height) const {
    if (empty()) return *this;
    return {first > by ? first - by : 0, last + by < height ? last + by : height - 1};
  }
};

/// Bit planes of horizontal sums, reused by all calls so that no call allocates.
struct MedianScratch {
  MedianScratch(int max_width, int max_height);
  std::vector<std::uint64_t> planes;
};

/// 5×5 median of a binary image: a pixel is set when 13 or more of its 25 neighbours are. The border is
/// replicated, as in cv::medianBlur. `rows` contains all set pixels of `source`. Rows of `result` outside the
/// returned range are not written and count as zero.
RowSpan median5x5(BitImage& source, RowSpan rows, MedianScratch& scratch, BitImage& result);
/// 3×3 erosion; pixels beyond the border count as set, as in cv::erode.
RowSpan erode3x3(BitImage& source, RowSpan rows, BitImage& result);
/// 3×3 dilation; pixels beyond the border count as not set, as in cv::dilate.
RowSpan dilate3x3(BitImage& source, RowSpan rows, BitImage& result);

}  // namespace capstan::vision
