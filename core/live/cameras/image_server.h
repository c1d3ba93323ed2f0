#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

namespace capstan::live {

/// Serves images of two cameras as a network camera does: Motion JPEG over HTTP, at /left, /right and, side
/// by side, /both. A client that reads slowly misses images and delays nobody.
class ImageServer {
 public:
  /// Listens on an IPv4 address and a port; 0: a free one. Throws base::InputError where it cannot.
  ImageServer(const std::string& host, std::uint16_t port);
  ~ImageServer();

  /// Replaces the images that are served, 8-bit BGR. An empty image is not sent. `stamp`: time of the
  /// exposure since 1970 [ns], sent with each image as X-Timestamp, in seconds; 0: none is sent.
  void publish(const cv::Mat& left, const cv::Mat& right, std::int64_t stamp = 0);
  std::uint16_t port() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::live
