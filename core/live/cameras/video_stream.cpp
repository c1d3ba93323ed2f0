#include "core/live/cameras/video_stream.h"

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <vector>

#include "core/base/error.h"
#include "core/live/cameras/http_images.h"
#include "core/live/cameras/http_url.h"

namespace capstan::live {
namespace {

using Clock = std::chrono::steady_clock;

/// FFmpeg's own messages are not for users: what fails is said by who asked. OpenCV sets FFmpeg's level from
/// this variable at every opening; it is set before there are other threads that read the environment.
[[maybe_unused]] const int kSilenced = setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // AV_LOG_QUIET

void apply(cv::VideoCapture& capture, const VideoSettings& settings) {
  const auto set = [&](int property, const std::optional<double>& value) {
    if (value) capture.set(property, *value);
  };
  if (settings.width > 0) capture.set(cv::CAP_PROP_FRAME_WIDTH, settings.width);
  if (settings.height > 0) capture.set(cv::CAP_PROP_FRAME_HEIGHT, settings.height);
  if (settings.rate > 0.0) capture.set(cv::CAP_PROP_FPS, settings.rate);
  if (settings.exposure) capture.set(cv::CAP_PROP_AUTO_EXPOSURE, 1.0);  // V4L2: manual
  set(cv::CAP_PROP_EXPOSURE, settings.exposure);
  set(cv::CAP_PROP_GAIN, settings.gain);
  if (settings.white_balance) capture.set(cv::CAP_PROP_AUTO_WB, 0.0);
  set(cv::CAP_PROP_WB_TEMPERATURE, settings.white_balance);
  if (settings.focus) capture.set(cv::CAP_PROP_AUTOFOCUS, 0.0);
  set(cv::CAP_PROP_FOCUS, settings.focus);
}

/// Whether FFmpeg reads images that are JPEG files (Motion JPEG).
bool givesJpeg(const cv::VideoCapture& capture) {
  const int code = static_cast<int>(capture.get(cv::CAP_PROP_FOURCC));
  return code ==
             cv::VideoWriter::fourcc('m', 'j', 'p', 'e') ||  // the codec's name, of streams without a code
         code == cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
}

}  // namespace

bool isNetworkStream(const std::string& from) { return from.find("://") != std::string::npos; }

class VideoStream::Impl {
 public:
  Impl(const std::string& from, const VideoSettings& settings, const std::atomic<bool>* cancelled)
      : file_(std::filesystem::is_regular_file(from)) {
    std::string reason = "cannot be opened as a camera or video";
    if (isHttpAddress(from)) {
      HttpImages::Opened opened = HttpImages::open(from, kOpening, cancelled);
      http_ = std::move(opened.images);
      if (http_) return;
      reason += ": " + opened.other;
    }
    const bool network = isNetworkStream(from);
    const int open = static_cast<int>(kOpening.count()), wait = static_cast<int>(kPatience.count());
    device_ = !network && !file_;
    if (!device_)
      capture_.open(from, cv::CAP_FFMPEG,
                    network ? std::vector<int>{cv::CAP_PROP_OPEN_TIMEOUT_MSEC, open,
                                               cv::CAP_PROP_READ_TIMEOUT_MSEC, wait}
                            : std::vector<int>{});
    else
      capture_.open(from, cv::CAP_V4L2);
    if (!capture_.isOpened())
      throw base::InputError({withoutPassword(from),
                              0,
                              {},
                              {},
                              std::move(reason),
                              "Check the device, address or file, and that no other program uses it"});
    if (!file_) apply(capture_, settings);
    jpeg_ = network && givesJpeg(capture_) && capture_.set(cv::CAP_PROP_FORMAT, -1.0);
    stamped_ = settings.rate <= 0.0;
    const double rate = stamped_ ? capture_.get(cv::CAP_PROP_FPS) : settings.rate;
    if (rate > 0.0) period_ = 1.0 / rate;
  }

  bool read(cv::Mat& image) {
    if (http_) return readHttp(image);
    cv::Mat raw;
    if (!capture_.grab()) return false;
    arrival_ = Clock::now();
    if (device_) arrival_ = driverTime(capture_.get(cv::CAP_PROP_POS_MSEC), arrival_);
    if (!capture_.retrieve(raw) || raw.empty()) return false;
    if (jpeg_) return cv::imdecode(raw, cv::IMREAD_COLOR, &image), !image.empty();
    if (raw.channels() == 3)
      image = raw;
    else
      cv::cvtColor(raw, image, raw.channels() == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_BGRA2BGR);
    if (file_) place(1e-3 * capture_.get(cv::CAP_PROP_POS_MSEC));
    return true;
  }
  std::int64_t skip(double seconds) {
    const auto images = static_cast<std::int64_t>(seconds / period_);
    if (!file_ || images <= 0 || !capture_.set(cv::CAP_PROP_POS_FRAMES, static_cast<double>(count_ + images)))
      return 0;
    count_ += images;
    if (!stamped_) position_ += static_cast<double>(images) * period_;
    return images;
  }
  bool isFile() const { return file_; }
  double position() const { return position_; }
  Clock::time_point arrival() const { return arrival_; }
  std::int64_t stamp() const { return stamp_; }
  std::uint64_t lost() const { return lost_; }

 private:
  /// Damaged images are passed over.
  bool readHttp(cv::Mat& image) {
    const Clock::time_point begin = Clock::now();
    lost_ = 0;
    for (JpegPart part; http_->next(part, kPatience); ++lost_) {
      lost_ += http_->lost();
      stamp_ = part.stamp, arrival_ = part.arrival;
      image = cv::imdecode(part.bytes, cv::IMREAD_COLOR);
      if (!image.empty()) return true;
      if (Clock::now() - begin > kPatience) break;
    }
    return false;
  }
  /// Sets the time of an image of a file with this time stamp [s]. Time stamps that do not rise are none.
  void place(double stamp) {
    if (count_++ == 0) {
      first_stamp_ = stamp;
      return;
    }
    const double by_stamp = stamp - first_stamp_;
    position_ = stamped_ && by_stamp > position_ ? by_stamp : position_ + period_;
  }

  const bool file_;
  bool device_ = false;
  bool jpeg_ = false;  ///< capture_ gives JPEG files: the time of arrival is known before they are decoded
  std::unique_ptr<HttpImages> http_;  ///< null: capture_ is read
  std::int64_t stamp_ = 0;
  std::uint64_t lost_ = 0;
  Clock::time_point arrival_;
  cv::VideoCapture capture_;
  bool stamped_ = true;         ///< the time stamps of a file count
  double period_ = 1.0 / 30.0;  ///< of a file's images; those without time stamps come so [s]
  double position_ = 0.0, first_stamp_ = 0.0;
  std::int64_t count_ = 0;
};

VideoStream::VideoStream(const std::string& from, const VideoSettings& settings,
                         const std::atomic<bool>* cancelled)
    : impl_(std::make_unique<Impl>(from, settings, cancelled)) {}
VideoStream::~VideoStream() = default;
bool VideoStream::read(cv::Mat& image) { return impl_->read(image); }
std::int64_t VideoStream::skip(double seconds) { return impl_->skip(seconds); }
bool VideoStream::isFile() const { return impl_->isFile(); }
double VideoStream::position() const { return impl_->position(); }
Clock::time_point VideoStream::arrival() const { return impl_->arrival(); }
std::int64_t VideoStream::stamp() const { return impl_->stamp(); }
std::uint64_t VideoStream::lost() const { return impl_->lost(); }

Clock::time_point driverTime(double driver_ms, Clock::time_point read) {
  const double read_ms = std::chrono::duration<double, std::milli>(read.time_since_epoch()).count();
  constexpr double kLongest = 1000.0;
  if (!(driver_ms > read_ms - kLongest && driver_ms <= read_ms)) return read;
  return read - std::chrono::duration_cast<Clock::duration>(
                    std::chrono::duration<double, std::milli>(read_ms - driver_ms));
}

}  // namespace capstan::live
