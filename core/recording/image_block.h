#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <opencv2/core/mat.hpp>

namespace capstan::recording {

/// Memory for images, from huge pages where the system has them: hundreds of megabytes are in place within a
/// fraction of a second, where small pages take seconds, in which images would be lost.
class ImageBlock {
 public:
  explicit ImageBlock(std::size_t bytes) : bytes_(bytes) {
    if (bytes == 0) return;
    void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw std::bad_alloc();
    begin_ = static_cast<std::uint8_t*>(at);
    madvise(begin_, bytes, MADV_HUGEPAGE);  // a wish
    for (std::size_t k = 0; k < bytes; k += kSmallPage) begin_[k] = 0;
  }
  ~ImageBlock() {
    if (begin_) munmap(begin_, bytes_);
  }
  ImageBlock(const ImageBlock&) = delete;
  ImageBlock& operator=(const ImageBlock&) = delete;

  /// The next image, 8-bit BGR. The block has to outlive it.
  cv::Mat take(int width, int height) {
    cv::Mat image(height, width, CV_8UC3, begin_ + taken_);
    taken_ += bytesOf(width, height);
    return image;
  }
  static std::size_t bytesOf(int width, int height) {
    return 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }

 private:
  static constexpr std::size_t kSmallPage = 4096;

  std::size_t bytes_, taken_ = 0;
  std::uint8_t* begin_ = nullptr;
};

}  // namespace capstan::recording
