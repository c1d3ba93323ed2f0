#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/recording/export.h"
#include "core/recording/session_images.h"
#include "core/recording/session_source.h"

namespace capstan::recording {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason,
                         const std::string& remedy) {
  throw base::InputError({path.string(), 0, {}, {}, reason, remedy});
}

/// Calls `each(frame)` for every pair of images, until it returns false or the work is cancelled.
template <class Each>
void forEachFrame(const std::filesystem::path& session, base::Progress* progress, Each&& each) {
  SessionSource source(session);
  tracking::Sample sample;
  while (source.next(sample)) {
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (!frame) continue;
    if (progress) {
      if (progress->cancelled()) return;
      const tracking::SourceInfo& info = source.info();
      if (info.duration > 0.0)
        progress->report(std::clamp((frame->t - info.begin) / info.duration, 0.0, 1.0), "frames");
    }
    each(*frame);
  }
}

int fourccFor(const std::filesystem::path& video) {
  const std::string suffix = video.extension().string();
  const std::map<std::string, int> known = {{".avi", cv::VideoWriter::fourcc('M', 'J', 'P', 'G')},
                                            // Lossless, and decoded in a third of FFV1's time.
                                            {".mkv", cv::VideoWriter::fourcc('H', 'F', 'Y', 'U')},
                                            {".mp4", cv::VideoWriter::fourcc('m', 'p', '4', 'v')}};
  const auto found = known.find(suffix);
  if (found == known.end())
    refuse(video, "has a suffix of no known container", "Choose .mkv (lossless), .avi or .mp4");
  return found->second;
}

/// Both views side by side; a missing view is black.
void sideBySide(const tracking::StereoFrame& frame, cv::Mat& both) {
  const cv::Size size = frame.left.empty() ? frame.right.size() : frame.left.size();
  both.create(size.height, 2 * size.width, CV_8UC3);
  cv::Mat left = both.colRange(0, size.width), right = both.colRange(size.width, 2 * size.width);
  frame.left.empty() ? void(left.setTo(0)) : frame.left.copyTo(left);
  frame.right.empty() ? void(right.setTo(0)) : frame.right.copyTo(right);
}

/// Times of exposure of the first and the last pair of images [s].
struct Exposures {
  double first = 0.0, last = 0.0;
};

Exposures exposuresOf(const std::filesystem::path& session, const SessionSummary& summary) {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  SessionImages images(session);
  tracking::StereoFrame first, last;
  images.at(summary.first_t, kAnywhere, first), images.at(summary.last_t, kAnywhere, last);
  return {first.t, last.t};
}

double meanRate(std::int64_t frames, const Exposures& exposures) {
  const double span = exposures.last - exposures.first;
  return frames > 1 && span > 0.0 ? std::clamp(static_cast<double>(frames - 1) / span, 1.0, 240.0) : 15.0;
}

/// Checks the video file by reading its packets without decoding, because the writer does not report a full
/// disk.
void checkWhole(const std::filesystem::path& file, std::int64_t frames, const std::filesystem::path& video) {
  constexpr double kUndecoded = -1.0;
  std::int64_t found = 0;
  cv::VideoCapture reader(file.string(), cv::CAP_FFMPEG);
  if (reader.isOpened() && reader.set(cv::CAP_PROP_FORMAT, kUndecoded))
    while (found < frames && reader.grab()) ++found;
  if (found < frames)
    refuse(video, fmt::format("took only {} of {} frames", found, frames), "Is the disk full?");
}

}  // namespace

std::int64_t exportPng(const std::filesystem::path& session, const std::filesystem::path& folder,
                       base::Progress* progress) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) refuse(folder, "cannot be created: " + fault.message(), "Choose another folder");
  std::int64_t pair = 0, images = 0;
  forEachFrame(session, progress, [&](const tracking::StereoFrame& frame) {
    ++pair;
    for (const auto& [side, image] : {std::pair{"left", &frame.left}, std::pair{"right", &frame.right}}) {
      if (image->empty()) continue;
      const std::filesystem::path file = folder / fmt::format("{}_{:06}.png", side, pair);
      if (!cv::imwrite(file.string(), *image, {cv::IMWRITE_PNG_COMPRESSION, 1}))
        refuse(file, "cannot be written", "Check the folder, its permissions and the space");
      ++images;
    }
  });
  return images;
}

VideoReport exportVideo(const std::filesystem::path& session, const std::filesystem::path& video,
                        base::Progress* progress) {
  const SessionSummary summary = readSessionSummary(session);
  if (summary.frames == 0) refuse(session, "holds no images", "Choose a session recorded with cameras");
  const int fourcc = fourccFor(video);
  base::PartFile part(video, base::PartFile::Keep::kSuffix);
  const Exposures exposures = exposuresOf(session, summary);
  VideoReport report;
  report.begin = exposures.first - summary.first_t;
  {
    cv::VideoWriter writer(part.path().string(), cv::CAP_FFMPEG, fourcc, meanRate(summary.frames, exposures),
                           {2 * summary.width, summary.height});
    if (!writer.isOpened())
      refuse(video, "cannot be written", "Check the folder, its permissions and the suffix");
    cv::Mat both;
    forEachFrame(session, progress, [&](const tracking::StereoFrame& frame) {
      if (frame.left.empty() && frame.right.empty()) return;
      sideBySide(frame, both);
      const bool fits = both.cols == 2 * summary.width && both.rows == summary.height;
      if (fits) writer.write(both);
      ++(fits ? report.frames : report.other_size);
    });
  }
  if (progress && progress->cancelled()) return report;
  checkWhole(part.path(), report.frames, video);
  part.commit();
  return report;
}

}  // namespace capstan::recording
