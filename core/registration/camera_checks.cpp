#include "core/registration/camera_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/registration/camera_order.h"
#include "core/vision/equal_images.h"

namespace capstan::registration {
namespace {

constexpr std::array kSides = {"left", "right"};
constexpr double kMemory = 0.1;       // weight of a new value in a running mean
constexpr int kMostFrozen = 3;        // equal images in a row that no camera gives
constexpr double kMostPeriods = 5.0;  // periods without a pair after which the images are missing
constexpr int kFewJudged = 8;         // pairs that decide on the order of the cameras
constexpr double kMargin = 6.0;       // [px] around the marker, for its edge

cv::Rect around(const vision::MarkerDetection& marker, const cv::Size& size) {
  const double reach = marker.radius + kMargin;
  const cv::Rect box(cvFloor(marker.centroid.x() - reach), cvFloor(marker.centroid.y() - reach),
                     cvCeil(2.0 * reach), cvCeil(2.0 * reach));
  return box & cv::Rect({0, 0}, size);
}

std::string both(double left, double right, const char* format) {
  return fmt::format(fmt::runtime(format), left) + ", " + fmt::format(fmt::runtime(format), right);
}

}  // namespace

const char* adviceAgainst(vision::MarkerFault fault) {
  switch (fault) {
    case vision::MarkerFault::kNoImage:
      return "Check that both cameras deliver images.";
    case vision::MarkerFault::kWrongImage:
      return "Use the camera files of these cameras at this resolution.";
    case vision::MarkerFault::kTwoCandidates:
      return "Remove other objects of the marker's colour from the view.";
    case vision::MarkerFault::kTooSmall:
    case vision::MarkerFault::kNotRound:
      return "Check that nothing covers the marker and that it is in focus.";
    default:
      return "Unblock the view, see that the marker is in both images, and check light and hue range.";
  }
}

CameraChecks::CameraChecks(const std::optional<vision::StereoRig>& rig, const vision::MarkerOptions& marker)
    : marker_(marker) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  blur_.fill(kNone);
  faults_.fill(vision::MarkerFault::kNoImage);
  if (!rig) return;
  watch_.emplace(*rig);
  triangulator_.emplace(*rig);
}

void CameraChecks::observe(const tracking::Snapshot& snapshot) {
  now_ = std::max(now_, snapshot.t);
  if (!snapshot.camera_updated || !snapshot.camera_images) return;
  if (watch_) watch_->observe(snapshot);
  judgeOrder(snapshot);
}

void CameraChecks::judgeOrder(const tracking::Snapshot& snapshot) {
  if (!triangulator_ || !snapshot.marker[0].found() || !snapshot.marker[1].found()) return;
  if (judged_ == 2 * kFewJudged) exchanged_ /= 2, judged_ /= 2;  // the newest pairs count most
  ++judged_;
  exchanged_ += cameraOrder(*triangulator_, snapshot.marker, kEpipolarLimit) == CameraOrder::kExchanged;
}

void CameraChecks::see(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot) {
  if (snapshot.camera_samples > samples_ && frame.t_arrival > newest_ && std::isfinite(newest_))
    period_ = (frame.t_arrival - newest_) / static_cast<double>(snapshot.camera_samples - samples_);
  samples_ = snapshot.camera_samples;
  newest_ = frame.t_arrival;
  now_ = std::max(now_, newest_);
  if (std::isfinite(frame.skew))
    skew_ = skew_ ? *skew_ + kMemory * (std::abs(frame.skew) - *skew_) : std::abs(frame.skew);
  for (std::size_t side = 0; side < 2; ++side) {
    const cv::Mat& image = side == 0 ? frame.left : frame.right;
    sizes_[side] = image.size();
    frozen_[side] = vision::areEqual(image, last_[side]) ? frozen_[side] + 1 : 0;
    image.copyTo(last_[side]);
    const vision::MarkerDetection& marker = snapshot.marker[side];
    faults_[side] = marker.fault;
    if (image.empty() || image.type() != CV_8UC3) continue;
    at_marker_[side] = marker.found();
    const cv::Rect area = marker.found() ? around(marker, image.size()) : cv::Rect({0, 0}, image.size());
    if (area.empty()) continue;
    blur_[side] = vision::edgeBlur(image(area));
    image_exposure_[side] = vision::exposureOf(image);
    exposure_[side] = marker.found()
                          ? vision::exposureOf(image(area), {marker.centroid.x() - area.x,
                                                             marker.centroid.y() - area.y, marker.radius})
                          : image_exposure_[side];
  }
}

void CameraChecks::setNow(double t, std::vector<tracking::SideStatus> sides) {
  now_ = std::max(now_, t);
  sides_ = std::move(sides);
}

std::vector<CameraCheck> CameraChecks::checks() const {
  return {images(), sameTime(), focus(), exposure(), marker(), geometry()};
}

/// Fails for the first camera stream that is silent or frozen.
std::optional<CameraCheck> CameraChecks::streamFault() const {
  using State = tracking::SideStatus::State;
  for (const tracking::SideStatus& side : sides_) {
    if (side.counted != "image" || (side.state != State::kSilent && side.state != State::kFrozen)) continue;
    const auto state = base::nameOf(side.state);
    return CameraCheck{
        .name = "images",
        .state = CheckState::kFail,
        .value =
            fmt::format("{} {} for {:.1f} s", side.part.empty() ? "both" : side.part, state, side.silent_for),
        .remedy = fmt::format("The {} is {}. Check cable, power and address of the camera ({}).",
                              side.part.empty() ? "camera side" : side.part + " camera", state, side.from)};
  }
  return std::nullopt;
}

/// Fails where one camera gives no image, repeats one, or has another size than its calibration.
std::optional<CameraCheck> CameraChecks::imageFault(std::size_t side) const {
  CameraCheck check{.name = "images", .state = CheckState::kFail};
  const char* name = kSides[side];
  if (sizes_[side].empty()) {
    check.value = fmt::format("{} gives none", name);
    check.remedy = fmt::format("The {} camera gives no image. Check its cable, power and address.", name);
    return check;
  }
  if (frozen_[side] >= kMostFrozen) {
    check.value = fmt::format("{} frozen", name);
    check.remedy = fmt::format("The {} camera repeats one image. Reconnect it, or restart its driver.", name);
    return check;
  }
  if (!watch_) return std::nullopt;
  const vision::Camera& camera = side == 0 ? watch_->rig().left : watch_->rig().right;
  if (sizes_[side] == cv::Size(camera.width, camera.height)) return std::nullopt;
  check.value = fmt::format("{} {} × {}", name, sizes_[side].width, sizes_[side].height);
  check.remedy = fmt::format(
      "The {} image has {} × {} px, its calibration {} × {}. Use the calibration of this size, or set the "
      "camera to that one.",
      name, sizes_[side].width, sizes_[side].height, camera.width, camera.height);
  return check;
}

CameraCheck CameraChecks::images() const {
  if (auto fault = streamFault()) return *fault;
  CameraCheck check{.name = "images"};
  if (!std::isfinite(newest_)) {
    check.value = "none yet";
    return check;
  }
  for (const std::size_t side : {1U, 0U})
    if (auto fault = imageFault(side)) return *fault;
  const double silent = now_ - newest_;
  const double patience = std::max(tracking::SideStatus::kSilence, kMostPeriods * period_);
  if (silent > patience) {
    check.state = CheckState::kFail;
    check.value = fmt::format("none for {:.1f} s", silent);
    check.remedy = "No images arrive. Check cable, power and address of both cameras.";
    return check;
  }
  check.state = CheckState::kPass;
  check.value = period_ > 0.0 ? fmt::format("{:.1f} /s", 1.0 / period_) : "arriving";
  return check;
}

CameraCheck CameraChecks::sameTime() const {
  CameraCheck check{.name = "same time"};
  if (!skew_) {
    check.value = "not known";  // a recording keeps one time for both
    return check;
  }
  check.value = fmt::format("{:.1f} ms", 1e3 * *skew_);
  check.state = *skew_ <= kLargestSkew ? CheckState::kPass : CheckState::kFail;
  if (check.state == CheckState::kFail)
    check.remedy = fmt::format(
        "The two images of a pair are {:.1f} ms apart; a tool at 0.1 m/s moves {:.1f} mm meanwhile, at most "
        "{:.0f} ms are allowed. Trigger the cameras together, set equal exposures and rates, or move the arm "
        "slowly.",
        1e3 * *skew_, base::toMillimetres(0.1 * *skew_), 1e3 * kLargestSkew);
  return check;
}

CameraCheck CameraChecks::focus() const {
  CameraCheck check{.name = "focus"};
  if (!std::isfinite(blur_[0]) || !std::isfinite(blur_[1])) {
    const bool none = std::isfinite(newest_);
    check.value = none ? "no edges" : "–";
    return check;
  }
  check.value = both(blur_[0], blur_[1], "{:.1f}") + " px";
  check.state = CheckState::kPass;
  for (std::size_t side = 0; side < 2; ++side) {
    if (blur_[side] <= vision::kLargestBlur) continue;
    check.state = CheckState::kFail;
    check.remedy = fmt::format(
        "Edges {} the {} image are blurred by {:.1f} px (standard deviation); beyond {:.1f} px the search "
        "for the marker's edge does not reach its background. Turn the focus of this camera, clean its lens, "
        "or hold the arm still.",
        at_marker_[side] ? "of the marker in" : "in", kSides[side], blur_[side], vision::kLargestBlur);
  }
  return check;
}

std::string CameraChecks::exposureFault(std::size_t side) const {
  const vision::Exposure& exposure = exposure_[side];
  const double most = at_marker_[side] ? kMostClipped : kMostClippedImage;
  const char* where = at_marker_[side] ? "the marker" : "the image";
  if (exposure.clipped > most)
    return fmt::format(
        "{:.0f} % of {} of the {} camera is overexposed ({} or more of 255); more than {:.0f} % changes its "
        "colour. Shorten the exposure, lower the gain, or dim the light.",
        1e2 * exposure.clipped, where, kSides[side], vision::kClipped, 1e2 * most);
  const double brightness = at_marker_[side] ? exposure.median : exposure.bright;
  const double least = kLeastBrightness * marker_.value_low;
  if (brightness < least)
    return fmt::format(
        "The {} image is too dark: {} has {:.0f} of 255; below {:.0f} its shaded side falls under the "
        "marker's smallest value ({}). Lengthen the exposure, raise the gain, or add light.",
        kSides[side], at_marker_[side] ? "half of the marker" : "95 % of it", brightness, least,
        marker_.value_low);
  return {};
}

CameraCheck CameraChecks::exposure() const {
  CameraCheck check{.name = "exposure"};
  if (!std::isfinite(newest_) || sizes_[0].empty() || sizes_[1].empty()) {
    check.value = "–";
    return check;
  }
  check.value = both(1e2 * exposure_[0].clipped, 1e2 * exposure_[1].clipped, "{:.0f}") + " % clipped";
  check.state = CheckState::kPass;
  for (std::size_t side = 0; side < 2; ++side) {
    std::string fault = exposureFault(side);
    if (fault.empty()) continue;
    check.state = CheckState::kFail;
    check.remedy = std::move(fault);
  }
  return check;
}

CameraCheck CameraChecks::marker() const {
  CameraCheck check{.name = "marker"};
  if (!std::isfinite(newest_)) {
    check.value = "–";
    return check;
  }
  check.state = CheckState::kPass;
  check.value = "in both images";
  for (std::size_t side = 0; side < 2; ++side) {
    if (faults_[side] == vision::MarkerFault::kNone) continue;
    check.state = CheckState::kFail;
    check.value = fmt::format("{}: {}", kSides[side], base::nameOf(faults_[side]));
    check.remedy = fmt::format("Marker in the {} image: {}. {}", kSides[side], base::nameOf(faults_[side]),
                               adviceAgainst(faults_[side]));
  }
  return check;
}

/// Whether the rays alone show exchanged cameras, before there are enough poses.
bool CameraChecks::seemExchanged() const {
  return watch_ && watch_->finding().verdict == StereoVerdict::kUnknown && judged_ >= kFewJudged &&
         2 * exchanged_ > judged_;
}

std::optional<CameraRemedy> CameraChecks::remedy() const {
  if (!watch_) return std::nullopt;
  const StereoFinding& finding = watch_->finding();
  if (seemExchanged()) return CameraRemedy{.correction = {.exchange = true, .mirror = {}, .flip = {}}};
  if (finding.verdict == StereoVerdict::kImages) return CameraRemedy{.correction = finding.correction};
  if (finding.verdict == StereoVerdict::kScale) return CameraRemedy{.correction = {}, .scale = finding.scale};
  return std::nullopt;
}

CameraCheck CameraChecks::geometry() const {
  CameraCheck check{.name = "geometry"};
  if (!watch_) {
    check.value = "not calibrated";
    return check;
  }
  const StereoFinding& finding = watch_->finding();
  const FindingWords words = wordsOf(finding, watch_->rig());
  check.value = words.value;
  if (seemExchanged()) {
    check.state = CheckState::kFail;
    check.value = "rays meet behind";
    check.remedy =
        "Most likely the left and the right camera are exchanged. Exchange them here, and left and right in "
        "the live set-up so that it stays. (Mirrored images look the same until the arm has moved.)";
    check.button = "Exchange the cameras";
    return check;
  }
  check.state = finding.verdict == StereoVerdict::kUnknown ? CheckState::kUnknown
                : finding.verdict == StereoVerdict::kFits  ? CheckState::kPass
                                                           : CheckState::kFail;
  if (check.state != CheckState::kFail) return check;
  check.remedy = fmt::format("Geometry: {}. {}.", words.reason, words.remedy);
  check.button = words.button;
  return check;
}

}  // namespace capstan::registration
