#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <opencv2/core/mat.hpp>
#include <stop_token>
#include <system_error>
#include <thread>

namespace capstan::recording {

/// Memory for images, from huge pages where the system has them. A thread populates it ahead of the images:
/// page faults of hundreds of megabytes take seconds, in which images would be lost.
class ImageBlock {
 public:
  /// Throws std::bad_alloc.
  explicit ImageBlock(std::size_t bytes) : bytes_(bytes) {
    if (bytes == 0) return;
    void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw std::bad_alloc();
    begin_ = static_cast<std::uint8_t*>(at);
    madvise(begin_, bytes, MADV_HUGEPAGE);  // the system may ignore it
    try {
      populating_ = std::jthread([this](const std::stop_token& stop) { populate(stop); });
    } catch (const std::system_error&) {  // no thread can be started: images populate it
    }
  }
  ~ImageBlock() {
    populating_ = {};
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
  /// Does not change the contents. Where the system refuses it, pages are populated when images are written.
  void populate(const std::stop_token& stop) {
    constexpr std::size_t kPart = std::size_t{8} << 20;
    for (std::size_t at = 0; at < bytes_ && !stop.stop_requested(); at += kPart)
      if (madvise(begin_ + at, std::min(kPart, bytes_ - at), MADV_POPULATE_WRITE) != 0) return;
  }

  std::size_t bytes_, taken_ = 0;
  std::uint8_t* begin_ = nullptr;
  std::jthread populating_;
};

/// For the images of a session. Throws base::InputError that names it if the memory is not available.
std::unique_ptr<ImageBlock> makeImageBlock(const std::filesystem::path& session, std::size_t bytes);

}  // namespace capstan::recording
