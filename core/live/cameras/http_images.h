#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/live/cameras/multipart_parser.h"

namespace capstan::live {

/// Images of a Motion JPEG stream over HTTP ("http://…", multipart/x-mixed-replace). They are received on a
/// thread of their own, so that the time of arrival does not depend on when next() is called.
class HttpImages {
 public:
  struct Opened {
    std::unique_ptr<HttpImages> images;  ///< null: what answers is no Motion JPEG
    std::string other;                   ///< then what it is: "the server sends text/html"
  };
  /// Connects, and waits up to `patience` for the first image, or until `*cancelled`. Throws base::InputError
  /// with the reason where nothing answers, or the answer is an error.
  static Opened open(const std::string& address, std::chrono::milliseconds patience,
                     const std::atomic<bool>* cancelled = nullptr);
  ~HttpImages();

  /// Waits for the next image. False: the stream has ended or gives none for `patience`. Throws
  /// base::InputError where what comes is no Motion JPEG any more.
  bool next(JpegPart& part, std::chrono::milliseconds patience);
  /// Number of images dropped between the last two that next() returned, because kWaiting were waiting.
  std::uint64_t lost() const { return lost_; }

  static constexpr std::size_t kWaiting = 16;  ///< images that may wait; the oldest are dropped

 private:
  class Reader;
  explicit HttpImages(std::unique_ptr<Reader> reader);
  std::unique_ptr<Reader> reader_;
  std::uint64_t lost_ = 0;
};

}  // namespace capstan::live
