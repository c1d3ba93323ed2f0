// Marker detection against the same steps with OpenCV's own calls, one thread, on cold frames: every frame is
// visited once a round, and a round is larger than the caches. Medians of single calls; ratios from one run.
// "three calls" are cvtColor, inRange and findContours alone, without the median filter and the opening.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/vision/marker_detector.h"
#include "tests/support/disc_image.h"
#include "tests/support/plain_marker.h"

namespace {

using namespace capstan;
using Clock = std::chrono::steady_clock;

constexpr int kRounds = 15;
/// Images of one size. `frames` are copies of `scenes`.
struct Set {
  cv::Size size;
  int scenes, frames;
};
constexpr int kVga = 96, kHd = 32;  // frames of 640 x 480 and 1280 x 720: 88 MB each

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Frame {
  cv::Mat image;
  Eigen::Vector2d truth;
  cv::Rect roi;
};

std::vector<Frame> renderFrames(const vision::MarkerOptions& options, const Set& set) {
  base::Random random(8, "detection benchmark");
  std::vector<Frame> frames;
  for (int i = 0; i < set.scenes; ++i) {
    testing::DiscScene scene;
    scene.width = set.size.width;
    scene.height = set.size.height;
    scene.centre = {random.uniform(60, set.size.width - 60), random.uniform(60, set.size.height - 60)};
    scene.radius = random.uniform(8, 14) * set.size.width / 640.0;
    const Eigen::Vector2d predicted =
        scene.centre + Eigen::Vector2d(random.normal(0, 8), random.normal(0, 8));
    frames.push_back({testing::renderDisc(scene, random), scene.centre,
                      vision::roiAround(predicted, options, cv::Size(scene.width, scene.height))});
  }
  for (int i = set.scenes; i < set.frames; ++i) {
    const Frame& same = frames[i - set.scenes];
    frames.push_back({same.image.clone(), same.truth, same.roi});
  }
  return frames;
}

template <class Work>
void timeRound(const std::vector<Frame>& frames, std::vector<double>& microseconds, Work&& work) {
  for (const Frame& frame : frames) {
    const auto start = Clock::now();
    work(frame);
    microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
}

struct Distances {
  std::vector<double> values;
  void print(const char* what) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    fmt::print("  {:<52} mean {:.3f}  95 % {:.3f}  largest {:.3f} px\n", what,
               sum / static_cast<double>(values.size()), quantile(values, 0.95), quantile(values, 1.0));
  }
};

bool compareCentroids(const std::vector<Frame>& frames, int scenes, const vision::MarkerOptions& options,
                      vision::MarkerDetector& detector, testing::PlainMarker& plain) {
  Distances contour_plain, circle_plain, circle_truth, plain_truth;
  for (int i = 0; i < scenes; ++i) {
    const Frame& frame = frames[i];
    for (const cv::Rect& roi : {frame.roi, cv::Rect(0, 0, frame.image.cols, frame.image.rows)}) {
      const vision::MarkerDetection mine = detector.detect(frame.image, roi);
      const auto theirs = plain.detect(frame.image(roi), options);
      if (!mine.found() || !theirs) {
        fmt::print("frame {}: {}\n", i, mine.found() ? "lost by OpenCV" : base::nameOf(mine.fault));
        return false;
      }
      const Eigen::Vector2d theirs_px = *theirs + Eigen::Vector2d(roi.x, roi.y);
      contour_plain.values.push_back((mine.contour_centroid - theirs_px).norm());
      circle_plain.values.push_back((mine.centroid - theirs_px).norm());
      circle_truth.values.push_back((mine.centroid - frame.truth).norm());
      plain_truth.values.push_back((theirs_px - frame.truth).norm());
    }
  }
  fmt::print("centroids\n");
  contour_plain.print("contour centroid to OpenCV's");
  circle_plain.print("sub-pixel centroid to OpenCV's");
  circle_truth.print("sub-pixel centroid to the truth");
  plain_truth.print("OpenCV's centroid to the truth");
  return true;
}

/// What a first program would do: threshold the hue, take the contours.
void threeCalls(const cv::Mat& bgr, const vision::MarkerOptions& options) {
  static cv::Mat hsv, mask;
  static std::vector<std::vector<cv::Point>> contours;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  cv::inRange(hsv, cv::Scalar(options.hue_low, options.saturation_low, options.value_low),
              cv::Scalar(options.hue_high, 255, 255), mask);
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
}

/// False: a marker was not found.
bool benchmark(const Set& set) {
  const vision::MarkerOptions options;
  const std::vector<Frame> frames = renderFrames(options, set);
  vision::MarkerDetector detector(options, set.size.width, set.size.height);
  testing::PlainMarker plain;
  std::vector<double> full, full_plain, full_three, roi, roi_plain;
  for (int round = 0; round < kRounds; ++round) {
    timeRound(frames, full_plain, [&](const Frame& frame) { plain.detect(frame.image, options); });
    timeRound(frames, full, [&](const Frame& frame) { detector.detect(frame.image); });
    timeRound(frames, full_three, [&](const Frame& frame) { threeCalls(frame.image, options); });
    timeRound(frames, roi_plain, [&](const Frame& frame) { plain.detect(frame.image(frame.roi), options); });
    timeRound(frames, roi, [&](const Frame& frame) { detector.detect(frame.image, frame.roi); });
  }
  fmt::print("Marker detection, {} x {}, cold frames ({} frames, {} rounds), one thread\n", set.size.width,
             set.size.height, set.frames, kRounds);
  fmt::print("medians [us]                 Capstan    OpenCV     ratio\n");
  const auto line = [](const char* what, double mine, double theirs) {
    fmt::print("  {:<24} {:>9.1f} {:>9.1f} {:>8.1f} x\n", what, mine, theirs, theirs / mine);
  };
  const double f = quantile(full, 0.5), fp = quantile(full_plain, 0.5), r = quantile(roi, 0.5),
               rp = quantile(roi_plain, 0.5);
  line("full frame", f, fp);
  line("full frame, three calls", f, quantile(full_three, 0.5));
  line("region 100 x 100", r, rp);
  fmt::print("  99 % of the full frames: {:.1f} us (OpenCV {:.1f} us)\n", quantile(full, 0.99),
             quantile(full_plain, 0.99));
  fmt::print("  region against full frame: {:.1f} x (OpenCV {:.1f} x)\n", f / r, fp / rp);
  return compareCentroids(frames, set.scenes, options, detector, plain);
}

}  // namespace

int main() {
  cv::setNumThreads(1);
  fmt::print("{}, OpenCV {}\n", processorName(), CV_VERSION);
  const bool vga = benchmark({{640, 480}, 32, kVga}), hd = benchmark({{1280, 720}, 8, kHd});
  return vga && hd ? 0 : 1;
}
