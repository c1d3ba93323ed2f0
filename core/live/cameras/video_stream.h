#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace capstan::live {

/// Settings of a camera; a setting that is not given stays as it is.
struct VideoSettings {
  int width = 0, height = 0;                                   ///< [px]; 0: as the device gives it
  double rate = 0.0;                                           ///< [1/s]; 0: as the device gives it
  std::optional<double> exposure, gain, white_balance, focus;  ///< in the device's own units
};

/// Whether `from` is the address of a network stream ("rtsp://…", "http://…") rather than a device or a file.
bool isNetworkStream(const std::string& from);

/// Images of a V4L2 device ("/dev/video0"), of a network stream ("rtsp://…", "udp://…", "tcp://…",
/// "http://…") or of a video file, whose images are given as fast as they are read. Motion JPEG over HTTP is
/// received by HttpImages, all else by FFmpeg.
class VideoStream {
 public:
  /// Throws base::InputError with the reason where the stream cannot be opened. `*cancelled` ends the waiting
  /// for a silent server of Motion JPEG.
  VideoStream(const std::string& from, const VideoSettings& settings,
              const std::atomic<bool>* cancelled = nullptr);
  ~VideoStream();

  /// Waits for the next image, 8-bit BGR. False: the stream has ended or gives nothing for kPatience. Throws
  /// base::InputError where a stream turns out to be damaged.
  bool read(cv::Mat& image);
  bool isFile() const;
  /// Passes over the images of a video file of the next `seconds`, without decoding most of them. Returns
  /// their number; 0 where the file cannot be searched.
  std::int64_t skip(double seconds);
  /// Time of the last image of a video file after its first one [s]: by the time stamps of the file, or by
  /// VideoSettings::rate where it is given.
  double position() const;
  /// When the last image arrived: the time at which the driver of a V4L2 device had it (a busy computer reads
  /// it later), else the time at which it could be read; of Motion JPEG, the time before its decoding.
  std::chrono::steady_clock::time_point arrival() const;
  /// Time of the last image by the clock of its camera, X-Timestamp of Motion JPEG over HTTP [ns]; 0: none.
  std::int64_t stamp() const;
  /// Number of images of Motion JPEG over HTTP that were dropped between the last two read() returned, or
  /// that were damaged.
  std::uint64_t lost() const;

  static constexpr std::chrono::milliseconds kPatience{1000};
  /// For opening a network stream: FFmpeg looks at its first images, and RTSP cameras begin with a key image.
  static constexpr std::chrono::milliseconds kOpening{5000};

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Time of arrival of an image whose driver gives `driver_ms` [ms] on the monotonic clock, and that was read
/// at `read`. A time that is not within the second before `read` is by another clock: then it is `read`.
std::chrono::steady_clock::time_point driverTime(double driver_ms,
                                                 std::chrono::steady_clock::time_point read);

}  // namespace capstan::live
