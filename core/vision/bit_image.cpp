#include "core/vision/bit_image.h"

#include <algorithm>

#include "core/base/check.h"

namespace capstan::vision {

BitImage::BitImage(int max_width, int max_height) {
  resize(max_width, 1);
  data_.assign(stride() * static_cast<std::size_t>(max_height), 0);
  resize(max_width, max_height);
}

void BitImage::resize(int width, int height) {
  width_ = width;
  height_ = height;
  words_ = (width + 63) / 64;
  CAPSTAN_CHECK(data_.empty() || stride() * static_cast<std::size_t>(height) <= data_.size());
}

void BitImage::fillBeyond(int y, bool left, bool right) {
  std::uint64_t* bits = row(y);
  bits[-1] = left ? ~std::uint64_t{0} : 0;
  bits[words_] = right ? ~std::uint64_t{0} : 0;
  if (right)
    bits[words_ - 1] |= ~lastWordMask();
  else
    bits[words_ - 1] &= lastWordMask();
}

bool BitImage::anySet(int first_row, int last_row) const {
  for (int y = first_row; y <= last_row; ++y) {
    std::uint64_t any = row(y)[words_ - 1] & lastWordMask();
    for (int i = 0; i + 1 < words_; ++i) any |= row(y)[i];
    if (any != 0) return true;
  }
  return false;
}

MedianScratch::MedianScratch(int max_width, int max_height)
    : planes(3 * BitImage::paddedWords((max_width + 63) / 64) * (static_cast<std::size_t>(max_height) + 1)) {}

}  // namespace capstan::vision
