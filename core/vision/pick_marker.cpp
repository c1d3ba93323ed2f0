#include "core/vision/pick_marker.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/stats/quantile.h"
#include "core/vision/marker_detector.h"

namespace capstan::vision {
namespace {

constexpr int kLeastSaturation = 40, kLeastValue = 20;  // below these the hue of a camera's pixel is noise
// Shares of the marker's medians. On pictures of a red mark on a da Vinci jaw, 0.5 to 0.65 of the value leave
// the smallest error; the saturation's share hardly matters up to 0.6.
constexpr double kSaturationShare = 0.5, kValueShare = 0.6;
constexpr int kGrowHue = 8;           // hue around the pixel that belongs to the marker, at first
constexpr int kWidestHue = 15;        // 30°: half-way from red to yellow, yellow to green, …
constexpr int kBackgroundHue = 30;    // 60°: hues farther away do not move a limit
constexpr int kLeastArea = 16;        // [px]; the detector's median and erosion leave less of nothing
constexpr double kLargestArea = 0.1;  // of the frame
constexpr int kMargin = 3;            // pixels around the marker that mix its colour with others [px]
constexpr int kReach = 3;             // distance of the marker from the click [px]
constexpr int kRefinements = 2;       // of the marker's pixels and limits
constexpr int kTightenings = 6;       // steps towards the marker's own colours
constexpr double kShapeShare = 0.4;   // of the circularity; views of one irregular mark differ by half
constexpr double kOwnShare = 0.1;     // quantile of the marker's colours at which tightening ends

int hueDifference(int hue, int from) { return (hue - from + 270) % 180 - 90; }
int wrappedHue(int hue) { return (hue + 180) % 180; }

struct Colours {
  std::vector<double> hue, saturation, value;  // hue relative to a centre
};

struct Colour {
  int hue = 0, saturation = 0, value = 0;
};

Colour colourAround(const cv::Mat& hsv, const cv::Point& pixel) {
  const cv::Rect square = cv::Rect(pixel.x - 1, pixel.y - 1, 3, 3) & cv::Rect({}, hsv.size());
  const auto centre = hsv.at<cv::Vec3b>(pixel);
  Colours near;
  for (int y = square.y; y < square.br().y; ++y)
    for (int x = square.x; x < square.br().x; ++x) {
      const auto& other = hsv.at<cv::Vec3b>(y, x);
      near.hue.push_back(hueDifference(other[0], centre[0]));
      near.saturation.push_back(other[1]);
      near.value.push_back(other[2]);
    }
  return {wrappedHue(centre[0] + static_cast<int>(std::lround(stats::median(near.hue)))),
          static_cast<int>(std::lround(stats::median(near.saturation))),
          static_cast<int>(std::lround(stats::median(near.value)))};
}

MarkerOptions limitsAround(const Colour& colour, double hue_below, double hue_above) {
  MarkerOptions limits;
  limits.hue_low = wrappedHue(colour.hue - static_cast<int>(std::lround(hue_below)));
  limits.hue_high = wrappedHue(colour.hue + static_cast<int>(std::lround(hue_above)));
  limits.saturation_low = std::max(kLeastSaturation, static_cast<int>(kSaturationShare * colour.saturation));
  limits.value_low = std::max(kLeastValue, static_cast<int>(kValueShare * colour.value));
  limits.min_radius = 0.5;
  limits.min_circularity = 0.0;
  return limits;
}

// Pixels inside the limits, cleaned as the detector does it.
cv::Mat cleanedMask(const cv::Mat& bgr, const MarkerOptions& limits) {
  MarkerDetector detector(limits, bgr.cols, bgr.rows);
  detector.detect(bgr);
  return detector.mask();
}

struct Areas {
  cv::Mat mark;                 // mask of the area at the click; empty where there is none
  cv::Rect bounds;              // of the mark
  int area = 0;                 // of the mark [px]
  int others = 0, largest = 0;  // areas elsewhere: sum and largest [px]
};

Areas areasIn(const cv::Mat& mask, const cv::Point& pixel) {
  cv::Mat labels, boxes, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, boxes, centroids, 8, CV_32S);
  Areas areas;
  int at = 0;
  double nearest = kReach * kReach + 0.5;
  const cv::Rect square = cv::Rect(pixel.x - kReach, pixel.y - kReach, 2 * kReach + 1, 2 * kReach + 1) &
                          cv::Rect({}, mask.size());
  for (int y = square.y; y < square.br().y; ++y)
    for (int x = square.x; x < square.br().x; ++x) {
      const double distance = (cv::Point(x, y) - pixel).ddot(cv::Point(x, y) - pixel);
      if (labels.at<int>(y, x) == 0 || distance >= nearest) continue;
      nearest = distance;
      at = labels.at<int>(y, x);
    }
  for (int label = 1; label < count; ++label) {
    const int area = boxes.at<int>(label, cv::CC_STAT_AREA);
    if (label == at) continue;
    areas.others += area;
    areas.largest = std::max(areas.largest, area);
  }
  if (at == 0) return areas;
  areas.mark = labels == at;
  areas.area = boxes.at<int>(at, cv::CC_STAT_AREA);
  areas.bounds = {boxes.at<int>(at, cv::CC_STAT_LEFT), boxes.at<int>(at, cv::CC_STAT_TOP),
                  boxes.at<int>(at, cv::CC_STAT_WIDTH), boxes.at<int>(at, cv::CC_STAT_HEIGHT)};
  return areas;
}

Colours coloursIn(const cv::Mat& hsv, const cv::Mat& mask, int centre, const MarkerOptions& limits) {
  Colours colours;
  for (int y = 0; y < hsv.rows; ++y)
    for (int x = 0; x < hsv.cols; ++x) {
      const auto& pixel = hsv.at<cv::Vec3b>(y, x);
      if (mask.at<std::uint8_t>(y, x) == 0 || pixel[1] < limits.saturation_low || pixel[2] < limits.value_low)
        continue;
      colours.hue.push_back(hueDifference(pixel[0], centre));
      colours.saturation.push_back(pixel[1]);
      colours.value.push_back(pixel[2]);
    }
  return colours;
}

// Distance of a hue limit from the marker's hue: half-way to the background's median hue on the side `sign`.
double hueWidth(const Colours& background, int sign, int area) {
  std::vector<double> side;
  for (double hue : background.hue)
    if (sign * hue > 0.0 && sign * hue <= kBackgroundHue) side.push_back(sign * hue);
  if (static_cast<int>(side.size()) < area) return kWidestHue;
  return std::min<double>(kWidestHue, 0.5 * stats::median(side));
}

struct Limits {
  MarkerOptions options;
  Colour colour;                            // medians of the marker
  double below = 0.0, above = 0.0;          // distances of the hue limits from the marker's hue
  double own_below = 0.0, own_above = 0.0;  // those that still contain nearly all of the marker
  int own_saturation = 0, own_value = 0;
};

Limits limitsBetween(const cv::Mat& hsv, const Areas& areas, const MarkerOptions& old, int hue) {
  const Colours mark = coloursIn(hsv, areas.mark, hue, old);
  Limits limits;
  const auto quantile = [](const std::vector<double>& values, double p) {
    return stats::quantile(values, p);
  };
  const double middle = stats::median(mark.hue);
  limits.colour = {wrappedHue(hue + static_cast<int>(std::lround(middle))),
                   static_cast<int>(stats::median(mark.saturation)),
                   static_cast<int>(stats::median(mark.value))};
  cv::Mat around;
  cv::dilate(areas.mark, around,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kMargin + 1, 2 * kMargin + 1}));
  const MarkerOptions wide = limitsAround(limits.colour, 0.0, 0.0);
  const Colours background = coloursIn(hsv, around == 0, limits.colour.hue, wide);
  limits.below = hueWidth(background, -1, areas.area);
  limits.above = hueWidth(background, 1, areas.area);
  limits.own_below = std::max(1.0, middle - quantile(mark.hue, kOwnShare));
  limits.own_above = std::max(1.0, quantile(mark.hue, 1.0 - kOwnShare) - middle);
  limits.own_saturation = static_cast<int>(quantile(mark.saturation, kOwnShare));
  limits.own_value = static_cast<int>(quantile(mark.value, kOwnShare));
  limits.options = limitsAround(limits.colour, limits.below, limits.above);
  return limits;
}

// Limits a share of the way from the widest to the marker's own colours.
MarkerOptions tightened(const Limits& limits, double share) {
  const auto between = [&](double wide, double own) { return wide + share * (own - wide); };
  MarkerOptions options =
      limitsAround(limits.colour, between(limits.below, std::min(limits.below, limits.own_below)),
                   between(limits.above, std::min(limits.above, limits.own_above)));
  options.saturation_low = std::max(options.saturation_low,
                                    static_cast<int>(between(options.saturation_low, limits.own_saturation)));
  options.value_low =
      std::max(options.value_low, static_cast<int>(between(options.value_low, limits.own_value)));
  return options;
}

bool isQuiet(const Areas& areas, const MarkerOptions& options) {
  return areas.largest < options.candidate_ratio * areas.area;
}

}  // namespace

base::Result<PickedMarker, PickFault> pickMarker(const cv::Mat& bgr, const cv::Point& pixel) {
  if (!cv::Rect({}, bgr.size()).contains(pixel)) return base::failure(PickFault::kOutside);
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  const Colour seed = colourAround(hsv, pixel);
  if (seed.saturation < kLeastSaturation || seed.value < kLeastValue)
    return base::failure(PickFault::kNoColour);
  Limits limits;
  limits.options = limitsAround(seed, kGrowHue, kGrowHue);
  limits.colour = seed;
  Areas areas = areasIn(cleanedMask(bgr, limits.options), pixel);
  for (int round = 0; round <= kRefinements; ++round) {
    if (areas.area < kLeastArea) return base::failure(PickFault::kTooSmall);
    if (areas.area > kLargestArea * bgr.rows * bgr.cols) return base::failure(PickFault::kBackground);
    if (round == kRefinements) break;
    limits = limitsBetween(hsv, areas, limits.options, limits.colour.hue);
    areas = areasIn(cleanedMask(bgr, limits.options), pixel);
  }
  for (int step = 1; step <= kTightenings && !isQuiet(areas, limits.options); ++step) {
    const MarkerOptions options = tightened(limits, static_cast<double>(step) / kTightenings);
    Areas fewer = areasIn(cleanedMask(bgr, options), pixel);
    if (fewer.area < kLeastArea) break;
    limits.options = options;
    areas = std::move(fewer);
  }
  PickedMarker picked;
  picked.options = limits.options;
  picked.background = areas.others;
  picked.largest_background = areas.largest;
  const cv::Rect around =
      areas.bounds + cv::Size(4 * kMargin, 4 * kMargin) - cv::Point(2 * kMargin, 2 * kMargin);
  MarkerDetector detector(picked.options, bgr.cols, bgr.rows);
  picked.mark = detector.detect(bgr, around);
  if (!picked.mark.found() && picked.mark.fault != MarkerFault::kTwoCandidates)
    return base::failure(PickFault::kTooSmall);
  const MarkerOptions standard;
  picked.options.min_radius =
      std::clamp(0.5 * std::sqrt(areas.area / std::numbers::pi), 0.5, standard.min_radius * 10.0);
  picked.options.min_circularity = std::min(standard.min_circularity, kShapeShare * picked.mark.circularity);
  return picked;
}

}  // namespace capstan::vision
