#include "core/live/cameras/http_images.h"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <charconv>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "core/base/error.h"

namespace capstan::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::string_view kScheme = "http://";
constexpr int kOk = 200, kUnauthorized = 401, kFirstError = 400;

[[noreturn]] void refuse(const std::string& address, std::string reason, std::string remedy) {
  throw base::InputError({address, 0, {}, {}, std::move(reason), std::move(remedy)});
}

struct Url {
  std::string user, password, host, path;
  int port = 80;
};

/// Parts of "http://[USER:PASSWORD@]HOST[:PORT][/PATH]"; HOST may be an IPv6 address in brackets.
Url parseUrl(const std::string& address) {
  Url url;
  std::string_view rest = std::string_view(address).substr(kScheme.size());
  const std::size_t slash = std::min(rest.find_first_of("/?"), rest.size());
  url.path = rest.substr(slash);
  if (!url.path.starts_with('/')) url.path.insert(0, "/");
  rest = rest.substr(0, slash);
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    const std::size_t colon = std::min(rest.find(':'), at);
    url.user = rest.substr(0, colon);
    if (colon < at) url.password = rest.substr(colon + 1, at - colon - 1);
    rest = rest.substr(at + 1);
  }
  const std::size_t bracket = rest.starts_with('[') ? rest.find(']') : 0;
  const std::size_t colon = bracket == std::string_view::npos ? bracket : rest.find(':', bracket);
  url.host = rest.substr(bracket > 0 ? 1 : 0, bracket > 0 ? bracket - 1 : colon);
  const std::string_view port = colon < rest.size() ? rest.substr(colon + 1) : "80";
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), url.port);
  if (url.host.empty() || error != std::errc() || end != port.data() + port.size() || url.port < 1 ||
      url.port > 65535)
    refuse(address, "not an address of the form http://HOST:PORT/PATH", "Correct the address");
  return url;
}

}  // namespace

class HttpImages::Reader {
 public:
  explicit Reader(const std::string& address, std::chrono::milliseconds patience)
      : address_(address), url_(parseUrl(address)), client_(url_.host, url_.port) {
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

  enum class Kind { kUnknown, kMotionJpeg, kOther };
  /// Waits for the first image, or for the end.
  Kind waitForKind(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return kind_ != Kind::kUnknown || ended_; });
    if (kind_ == Kind::kUnknown && fault_) std::rethrow_exception(fault_);
    return kind_;
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
    if (!result && !answered_)
      keepFault([&]() -> bool {
        refuse(address_, "no server answers there", "Start the camera's server, or correct the address");
      });
    end(answered_ && !multipart_ && !parser_.begun());
  }
  bool take(std::string_view bytes) {
    parser_.add(bytes, Clock::now(), [&](JpegPart&& part) { keep(std::move(part)); });
    return !quit_ && !parser_.ended();
  }
  /// Streams whose type says nothing (ffmpeg's) are looked at.
  bool accept(const httplib::Response& response) {
    answered_ = true;
    const std::string type = response.get_header_value("Content-Type");
    multipart_ = type.starts_with("multipart/");
    const bool unknown = type.empty() || type.starts_with("application/octet-stream");
    if (response.status >= kFirstError && response.status != kUnauthorized) {
      multipart_ = true;  // what is said of it is final
      refuse(address_, fmt::format("the server answers {} {}", response.status, response.reason),
             "Correct the path of the address, or look at the server's own messages");
    }
    return response.status == kOk && (multipart_ || unknown);
  }
  void keep(JpegPart&& part) {
    {
      const std::lock_guard lock(mutex_);
      kind_ = Kind::kMotionJpeg;
      if (parts_.size() == kWaiting) parts_.pop_front(), ++lost_;
      parts_.push_back(std::move(part));
    }
    changed_.notify_all();
  }
  void end(bool other) {
    {
      const std::lock_guard lock(mutex_);
      fault_ = met_;
      if (other) kind_ = Kind::kOther;
      ended_ = true;
    }
    changed_.notify_all();
  }

  const std::string address_;
  const Url url_;
  httplib::Client client_;
  MultipartParser parser_;                     ///< of the thread, as the next three
  std::exception_ptr met_;                     ///< fault of the stream
  bool answered_ = false, multipart_ = false;  ///< multipart_: the server says so
  std::atomic<bool> quit_{false};

  std::mutex mutex_;  ///< protects the members below
  std::condition_variable changed_;
  Kind kind_ = Kind::kUnknown;
  std::deque<JpegPart> parts_;
  std::uint64_t lost_ = 0;  ///< dropped since the last image that next() returned
  std::exception_ptr fault_;
  bool ended_ = false;

  std::thread thread_;
};

std::unique_ptr<HttpImages> HttpImages::open(const std::string& address, std::chrono::milliseconds patience) {
  auto reader = std::make_unique<Reader>(address, patience);
  const Reader::Kind kind = reader->waitForKind(patience);
  if (kind == Reader::Kind::kOther) return nullptr;
  if (kind == Reader::Kind::kUnknown)
    refuse(address, "the server sends no image", "Check that the camera runs");
  return std::unique_ptr<HttpImages>(new HttpImages(std::move(reader)));
}

HttpImages::HttpImages(std::unique_ptr<Reader> reader) : reader_(std::move(reader)) {}
HttpImages::~HttpImages() = default;

bool HttpImages::next(JpegPart& part, std::chrono::milliseconds patience) {
  return reader_->next(part, lost_, patience);
}

bool isHttpAddress(const std::string& address) { return address.starts_with(kScheme); }

}  // namespace capstan::live
