#include "core/live/recorder_options.h"

#include <algorithm>

#include "core/tracking/make_pipeline.h"

namespace capstan::live {

namespace {

constexpr double kLeastTime = 2.0;  ///< time of a stalled disk that the buffers bridge [s]
constexpr double kFastest = 60.0;   ///< rate of image pairs for which kLeastTime holds [1/s]

}  // namespace

recording::RecorderOptions recorderOptionsFor(const tracking::SourceInfo& info, const RunStatus& status) {
  recording::RecorderOptions options;
  const double speed = std::max(1.0, status.speed);
  const bool not_yet_known = info.real_time && info.rig && status.frame_rate == 0.0;
  const double frames =
      not_yet_known ? kLeastTime * kFastest / options.buffered_time
                    : std::max(1.0 / tracking::trackingOptionsOf(info).camera_period, status.frame_rate);
  options.frame_rate = std::min(speed * frames, kFastest);
  options.motor_rate = speed * std::max(options.motor_rate, status.motor_rate);
  options.buffered_time =
      std::clamp(kLeastTime * kFastest / options.frame_rate, kLeastTime, options.buffered_time);
  options.wait = info.sender_waits;
  options.width = info.rig ? std::max(info.rig->left.width, info.rig->right.width) : 0;
  options.height = info.rig ? std::max(info.rig->left.height, info.rig->right.height) : 0;
  return options;
}

}  // namespace capstan::live
