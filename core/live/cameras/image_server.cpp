#include "core/live/cameras/image_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace capstan::live {
namespace {

enum Eye { kLeft, kRight, kBoth };
constexpr std::array kPaths = {"/left", "/right", "/both"};
constexpr int kQuality = 95;  // of JPEG: what cameras use that are made for measuring
constexpr std::chrono::milliseconds kWait{100};
constexpr int kWriteTimeout = 1;  // a client that takes nothing for so long is disconnected [s]

/// Images of one time. What a client asks for is encoded once, on the thread of the first one.
class Images {
 public:
  Images(const cv::Mat& left, const cv::Mat& right, std::int64_t stamp)
      : images_{left.clone(), right.clone(), cv::Mat()}, stamp_(stamp) {}

  const std::vector<unsigned char>& jpeg(Eye eye) {
    std::call_once(once_[eye], [&] {
      if (eye == kBoth && !images_[kLeft].empty() && images_[kLeft].size() == images_[kRight].size())
        cv::hconcat(images_[kLeft], images_[kRight], images_[kBoth]);
      if (!images_[eye].empty())
        cv::imencode(".jpg", images_[eye], jpegs_[eye], {cv::IMWRITE_JPEG_QUALITY, kQuality});
    });
    return jpegs_[eye];
  }
  /// Header line of the time of exposure.
  std::string timestamp() const {
    constexpr std::int64_t kMicrosecond = 1000, kSecond = 1000000;  // [ns], [µs]
    const std::int64_t time = stamp_ / kMicrosecond;
    return stamp_ == 0 ? "" : fmt::format("X-Timestamp: {}.{:06}\r\n", time / kSecond, time % kSecond);
  }

 private:
  std::array<cv::Mat, 3> images_;
  const std::int64_t stamp_;
  std::array<std::once_flag, 3> once_;
  std::array<std::vector<unsigned char>, 3> jpegs_;
};

}  // namespace

class ImageServer::Impl {
 public:
  Impl(const std::string& host, std::uint16_t port) {
    for (const Eye eye : {kLeft, kRight, kBoth})
      server_.Get(kPaths[eye], [this, eye](const httplib::Request&, httplib::Response& response) {
        response.set_content_provider(
            "multipart/x-mixed-replace; boundary=image",
            [this, eye, seen = newest()](std::size_t, httplib::DataSink& sink) mutable {
              return send(eye, seen, sink);
            });
      });
    server_.set_write_timeout(kWriteTimeout);
    server_.set_socket_options([](socket_t socket) {  // a port in use stays with its program
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    port_ = port == 0 ? server_.bind_to_any_port(host) : server_.bind_to_port(host, port) ? port : -1;
    if (port_ <= 0)
      throw base::InputError({"",
                              0,
                              {},
                              fmt::format("http://{}:{}", host, port),
                              "cannot be listened on",
                              "Use an address of this computer and a port that no other program uses"});
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }
  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    changed_.notify_all();
    server_.stop();
    thread_.join();
  }

  void publish(const cv::Mat& left, const cv::Mat& right, std::int64_t stamp) {
    auto images = std::make_shared<Images>(left, right, stamp);
    {
      const std::lock_guard lock(mutex_);
      images_ = std::move(images);
      ++sequence_;
    }
    changed_.notify_all();
  }
  int port() const { return port_; }

 private:
  /// A client that connects gets the images of later times.
  std::uint64_t newest() const {
    const std::lock_guard lock(mutex_);
    return sequence_;
  }
  /// Sends the next image to one client, or nothing after kWait. False: the server ends.
  bool send(Eye eye, std::uint64_t& seen, httplib::DataSink& sink) {
    std::shared_ptr<Images> images;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait_for(lock, kWait, [&] { return quit_ || sequence_ > seen; })) return true;
      if (quit_) return false;
      seen = sequence_;
      images = images_;
    }
    const std::vector<unsigned char>& jpeg = images->jpeg(eye);
    if (jpeg.empty()) return true;
    const std::string head =
        fmt::format("--image\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n{}\r\n", jpeg.size(),
                    images->timestamp());
    return sink.write(head.data(), head.size()) &&
           sink.write(reinterpret_cast<const char*>(jpeg.data()), jpeg.size()) && sink.write("\r\n", 2);
  }

  httplib::Server server_;
  int port_ = -1;
  mutable std::mutex mutex_;  ///< protects the members below
  std::condition_variable changed_;
  std::shared_ptr<Images> images_;
  std::uint64_t sequence_ = 0;
  bool quit_ = false;

  std::thread thread_;
};

ImageServer::ImageServer(const std::string& host, std::uint16_t port)
    : impl_(std::make_unique<Impl>(host, port)) {}
ImageServer::~ImageServer() = default;
void ImageServer::publish(const cv::Mat& left, const cv::Mat& right, std::int64_t stamp) {
  impl_->publish(left, right, stamp);
}
std::uint16_t ImageServer::port() const { return static_cast<std::uint16_t>(impl_->port()); }

}  // namespace capstan::live
