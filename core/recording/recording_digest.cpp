#include "core/recording/recording_digest.h"

#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/recording/session_file.h"
#include "core/recording/session_images.h"
#include "core/robot/description.h"

namespace capstan::recording {

RecordingDigest digestOf(const std::filesystem::path& recording, int width) {
  // By its name: opening the file outside SQLite would release the locks of a recorder on it.
  if (recording.extension() != kSessionSuffix) return {};
  const SessionSummary summary = readSessionSummary(recording);
  RecordingDigest digest;
  digest.created = summary.header.created;
  digest.duration = summary.last_t - summary.first_t;
  digest.robot = robot::parseDescription(summary.header.robot, recording.string()).name;
  tracking::StereoFrame first;
  if (summary.frames == 0 ||
      !SessionImages(recording).at(summary.first_t, std::numeric_limits<double>::infinity(), first))
    return digest;
  cv::resize(first.left, digest.image, {width, width * first.left.rows / first.left.cols}, 0.0, 0.0,
             cv::INTER_AREA);
  return digest;
}

}  // namespace capstan::recording
