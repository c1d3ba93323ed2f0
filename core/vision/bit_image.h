#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace capstan::vision {

/// Binary image, one bit a pixel, 64 pixels a word; bit 0 of word 0 is the leftmost pixel. One guard word
/// stands on either side of every row (words −1 and words()), so that filters read their neighbours without
/// asking. Storage is fixed at construction; resize() only changes the used part.
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
  /// Bits of the last word that are pixels.
  std::uint64_t lastWordMask() const {
    return (width_ & 63) ? (std::uint64_t{1} << (width_ & 63)) - 1 : ~std::uint64_t{0};
  }
  /// Words of a row that may be written, a multiple of four: filters run over all of them.
  static std::size_t paddedWords(int words) {
    return (static_cast<std::size_t>(words) + 3) & ~std::size_t{3};
  }
  std::size_t paddedWords() const { return paddedWords(words_); }
  /// Is any pixel of these rows set?
  bool anySet(int first_row, int last_row) const;
  /// Sets all bits beyond the image, guards included, of row y.
  void fillBeyond(int y, bool left, bool right);

 private:
  std::size_t stride() const { return paddedWords() + 2; }

  int width_ = 0, height_ = 0, words_ = 0;
  std::vector<std::uint64_t> data_;
};

/// Rows of an image that hold set pixels: [first, last], empty when first > last.
struct RowSpan {
  int first = 0, last = -1;
  bool empty() const { return first > last; }
  RowSpan grown(int by, int height) const {
    if (empty()) return *this;
    return {first > by ? first - by : 0, last + by < height ? last + by : height - 1};
  }
};

/// Bit planes of horizontal sums, kept between calls so that none is allocated.
struct MedianScratch {
  MedianScratch(int max_width, int max_height);
  std::vector<std::uint64_t> planes;
};

/// 5×5 median of a binary image: 13 or more of 25 set. The border is replicated, as in cv::medianBlur. `rows`
/// holds all set pixels of `source`. Rows of `result` outside the returned span are left untouched and mean
/// zero.
RowSpan median5x5(BitImage& source, RowSpan rows, MedianScratch& scratch, BitImage& result);
/// 3×3 erosion; pixels beyond the border count as set, as in cv::erode.
RowSpan erode3x3(BitImage& source, RowSpan rows, BitImage& result);
/// 3×3 dilation; pixels beyond the border count as not set, as in cv::dilate.
RowSpan dilate3x3(BitImage& source, RowSpan rows, BitImage& result);

}  // namespace capstan::vision
