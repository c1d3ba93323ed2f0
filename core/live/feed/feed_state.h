#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <type_traits>

/// What a session sends to its stereo monitors: one FeedState and one pair of images at a time. The
/// structures are plain memory of fixed size, as they lie in shared memory between two programs of one
/// machine.
namespace capstan::live {

/// What the estimate rests on.
enum class FeedTracking : std::int32_t {
  kTracking,      ///< the cameras
  kOccluded,      ///< the motors: the marker is hidden from a camera
  kRejected,      ///< the motors: the camera measurement is out of reach or jumped
  kUnregistered,  ///< the motors: the cameras' pose is unknown, nothing can be projected
  kNoCamera       ///< the motors: no camera samples
};

/// State of the session as a whole.
enum class FeedRun : std::int32_t { kRunning, kPaused, kEnded };

/// Reason why an eye has no image.
enum class FeedImage : std::int32_t {
  kShown,      ///< it has one
  kNone,       ///< its camera gave none
  kUnchanged,  ///< no new pair of images: the former one is still the newest
  kTooLarge,   ///< larger than kFeedWidth x kFeedHeight
  kFormat,     ///< not 8-bit grey or BGR
  kNoMemory    ///< the machine's shared memory is full
};

inline constexpr int kFeedWidth = 3840, kFeedHeight = 2160;  ///< largest image [px]
inline constexpr int kFeedShaft = 32;                        ///< most points of a projected shaft

/// One eye. Pixels are those of its image; pixel (0, 0) is the centre of the top-left pixel.
struct FeedEye {
  std::int32_t width = 0, height = 0;  ///< of the camera's image [px]
  std::int32_t channels = 0;           ///< 1 (grey) or 3 (BGR)
  FeedImage image = FeedImage::kNone;
  std::int32_t marker_found = 0;  ///< circle is valid
  std::int32_t tip_found = 0;     ///< tip and ellipse are valid
  std::int32_t shaft_points = 0;
  std::int32_t reserved = 0;
  std::array<double, 3> circle{};   ///< detected circle: centre x, y, radius [px]
  std::array<double, 3> tip{};      ///< marker at the estimate: centre x, y, radius [px]
  std::array<double, 3> ellipse{};  ///< 2 sigma of the tip: half axes [px], angle of the first [rad]
  std::array<std::array<double, 2>, kFeedShaft> shaft{};  ///< from the remote centre to the tip [px]
};

/// State of a session at one instant. Joints in rad, rad, m; NaN: not known.
struct FeedState {
  std::uint64_t number = 0;       ///< counts what the writer has published, from 1
  std::int64_t published_ns = 0;  ///< steady clock of the machine [ns]
  std::uint64_t session = 0;      ///< counts the sources that the writer has opened, from 1
  double t = 0.0;                 ///< time of the estimate in numbers below [s]
  double t_cam = 0.0;             ///< exposure of the images [s]
  double uncertain_for = 0.0;     ///< since when tracking is not kTracking [s]
  FeedTracking tracking = FeedTracking::kNoCamera;
  std::int32_t motor_fault = 0;                  ///< an encoder has failed
  std::array<double, 3> q{}, q_sigma{};          ///< joints of the filter, standard deviations
  std::array<double, 3> tip{}, tip_sigma{};      ///< tip in frame 0 [m]
  std::array<char, 64> words{};                  ///< state of the gate and of the encoders in words
  std::array<char, 128> title{};                 ///< of the session
  std::array<std::array<char, 24>, 3> joints{};  ///< names of the joints
  std::array<FeedEye, 2> eyes{};                 ///< left, right
};
static_assert(std::is_trivially_copyable_v<FeedState> && sizeof(FeedState) % 8 == 0);

/// What a reader receives: `images` are empty where FeedEye::image is not kShown.
struct FeedFrame {
  FeedState state;
  std::array<cv::Mat, 2> images;
};

/// Copies `text` into fixed memory, cut off at a whole character of UTF-8, with an end of zero.
void setText(char* to, std::size_t size, std::string_view text);
template <std::size_t n>
void setText(std::array<char, n>& to, std::string_view text) {
  setText(to.data(), n, text);
}
/// The text up to its zero or to the end of the memory.
template <std::size_t n>
std::string_view textOf(const std::array<char, n>& from) {
  const std::string_view all(from.data(), n);
  return all.substr(0, all.find('\0'));
}

/// Bytes of an eye's image; 0: none.
std::size_t imageBytes(const FeedEye& eye);

/// Makes bytes of unknown origin safe to use: a circle, tip or shaft with numbers that are not finite is
/// taken out, control characters of texts become spaces. False: an image's size or an enumeration is out of
/// range, so that nothing of it is to be used.
bool makeSafe(FeedState& state);

}  // namespace capstan::live
