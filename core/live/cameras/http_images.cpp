#include "core/live/cameras/http_images.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "core/base/error.h"
#include "core/live/cameras/http_url.h"

namespace capstan::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kOk = 200, kUnauthorized = 401, kFirstError = 400;

[[noreturn]] void refuse(const std::string& address, std::string reason, std::string remedy) {
  throw base::InputError({address, 0, {}, {}, std::move(reason), std::move(remedy)});
}

}  // namespace

class HttpImages::Reader {
 public:
  explicit Reader(const std::string& address, std::chrono::milliseconds patience)
      : address_(withoutPassword(address)), url_(parseHttpUrl(address)), client_(url_.host, url_.port) {
    client_.set_connection_timeout(patience);
    client_.set_read_timeout(patience);
    client_.set_follow_location(true);
    client_.set_url_encode(false);
    if (!url_.user.empty()) client_.set_basic_auth(url_.user, url_.password);
    thread_ = std::thread([this] { work(); });
  }
  ~Reader() {
    quit_ = true;
    client_.stop();
    thread_.join();
  }

  /// Waits for the first image. What comes instead throws base::InputError, or is said in words: "the server
  /// sends text/html".
  std::string waitForImage(std::chrono::milliseconds patience, const std::atomic<bool>* cancelled) {
    constexpr std::chrono::milliseconds kLook{50};  // for a cancellation
    std::unique_lock lock(mutex_);
    const Clock::time_point end = Clock::now() + patience;
    while (!changed_.wait_for(lock, kLook, [&] { return begun_ || ended_; }))
      if (Clock::now() >= end || (cancelled && *cancelled)) break;
    if (begun_ || !other_.empty()) return other_;
    if (fault_) std::rethrow_exception(fault_);
    if (answered_) refuse(address_, "the server sends no image", "Check that the camera runs");
    refuseSilence();
  }
  bool next(JpegPart& part, std::uint64_t& lost, std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return !parts_.empty() || ended_; });
    if (parts_.empty()) {
      if (fault_) std::rethrow_exception(fault_);
      return false;
    }
    part = std::move(parts_.front());
    parts_.pop_front();
    lost = std::exchange(lost_, 0);
    return true;
  }

 private:
  /// Calls `work`; a fault in it is kept, and no exception passes through the HTTP library.
  bool keepFault(const std::function<bool()>& work) {
    try {
      return base::namingFile(address_, work);
    } catch (...) {
      met_ = std::current_exception();
      return false;
    }
  }
  void work() {
    const httplib::Result result = client_.Get(
        url_.path, httplib::Headers{{"Accept", "*/*"}},
        [&](const httplib::Response& response) { return keepFault([&] { return accept(response); }); },
        [&](const char* data, std::size_t size) { return keepFault([&] {
                                                    return take({data, size});
                                                  }); });
    if (!result && !answered_) keepFault([&]() -> bool { refuseSilence(); });
    end();
  }
  [[noreturn]] void refuseSilence() const {
    refuse(address_, "no server answers there", "Start the camera's server, or correct the address");
  }
  bool take(std::string_view bytes) {
    parser_.add(bytes, Clock::now(), [&](JpegPart&& part) { keep(std::move(part)); });
    return !quit_ && !parser_.ended();
  }
  /// Streams whose type says nothing (ffmpeg's) are looked at.
  bool accept(const httplib::Response& response) {
    answered_ = true;
    otherwise_.clear();
    const std::string type = response.get_header_value("Content-Type");
    const bool unknown = type.empty() || type.starts_with("application/octet-stream");
    if (response.status >= kFirstError && response.status != kUnauthorized)
      refuse(address_, fmt::format("the server answers {} {}", response.status, response.reason),
             "Correct the path of the address, or look at the server's own messages");
    if (response.status == kUnauthorized)
      otherwise_ = url_.user.empty()
                       ? "the server asks for a user name and a password (http://USER:PASSWORD@HOST/PATH)"
                       : "the server refuses this user name and password";
    else if (!type.starts_with("multipart/"))
      otherwise_ = "the server sends " + (type.empty() ? "something of no stated type" : type);
    return response.status == kOk && (otherwise_.empty() || unknown);
  }
  void keep(JpegPart&& part) {
    {
      const std::lock_guard lock(mutex_);
      begun_ = true;
      if (parts_.size() == kWaiting) parts_.pop_front(), ++lost_;
      parts_.push_back(std::move(part));
    }
    changed_.notify_all();
  }
  void end() {
    {
      const std::lock_guard lock(mutex_);
      fault_ = met_;
      if (!parser_.begun()) other_ = otherwise_;
      ended_ = true;
    }
    changed_.notify_all();
  }

  const std::string address_;
  const HttpUrl url_;
  httplib::Client client_;
  MultipartParser parser_;  ///< of the thread, as the next two
  std::exception_ptr met_;  ///< fault of the stream
  std::string otherwise_;   ///< what the server sends unless images follow; empty: it promises images
  std::atomic<bool> answered_{false}, quit_{false};

  std::mutex mutex_;  ///< protects the members below
  std::condition_variable changed_;
  bool begun_ = false;  ///< an image has come
  std::string other_;   ///< what has come instead; empty: images, or it is not known yet
  std::deque<JpegPart> parts_;
  std::uint64_t lost_ = 0;  ///< dropped since the last image that next() returned
  std::exception_ptr fault_;
  bool ended_ = false;

  std::thread thread_;
};

HttpImages::Opened HttpImages::open(const std::string& address, std::chrono::milliseconds patience,
                                    const std::atomic<bool>* cancelled) {
  auto reader = std::make_unique<Reader>(address, patience);
  std::string other = reader->waitForImage(patience, cancelled);
  if (!other.empty()) return {nullptr, std::move(other)};
  return {std::unique_ptr<HttpImages>(new HttpImages(std::move(reader))), {}};
}

HttpImages::HttpImages(std::unique_ptr<Reader> reader) : reader_(std::move(reader)) {}
HttpImages::~HttpImages() = default;

bool HttpImages::next(JpegPart& part, std::chrono::milliseconds patience) {
  return reader_->next(part, lost_, patience);
}

}  // namespace capstan::live
