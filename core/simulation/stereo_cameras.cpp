#include "core/simulation/stereo_cameras.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/tracking/stereo_tip.h"
#include "core/vision/cover_image.h"
#include "core/vision/registration.h"

namespace capstan::simulation {
namespace {

constexpr double kLeastSigma = 0.05;  // noise that the triangulator assumes where pixels are exact [px]

/// True when only its buffer holds `image`.
bool isFree(const cv::Mat& image) { return image.u == nullptr || CV_XADD(&image.u->refcount, 0) == 1; }

Eigen::Vector3d nowhere() { return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()); }

}  // namespace

StereoCameras::StereoCameras(const vision::StereoRig& rig, const Eigen::Isometry3d& base_from_camera,
                             const SceneSizes& sizes, const Truth& truth, bool images, int buffers,
                             std::uint64_t seed)
    : timing_(truth.cameras),
      images_(images),
      triangulator_(rig),
      frames_(static_cast<std::size_t>(images ? std::max(1, buffers) : 0)),
      clock_(seed, "camera clock"),
      pixels_(seed, "marker pixels") {
  flights_.reserve(64);
  const Eigen::Isometry3d left_from_base = base_from_camera.inverse();
  renderers_.emplace_back(rig.left, left_from_base, sizes, truth.images, timing_.exposure, seed, 0);
  renderers_.emplace_back(rig.right, rig.right_from_left * left_from_base, sizes, truth.images,
                          timing_.exposure, seed, 1);
}

double StereoCameras::jitter(double sigma) { return sigma * std::clamp(clock_.normal(), -3.0, 3.0); }

StereoCameras::ImagePair& StereoCameras::freePair() {
  for (std::size_t tried = 0; tried < frames_.size(); ++tried) {
    ImagePair& images_now = frames_[next_frame_++ % frames_.size()];
    if (isFree(images_now[0]) && isFree(images_now[1])) return images_now;
  }
  ImagePair& images_now = frames_[next_frame_++ % frames_.size()];
  images_now = ImagePair{};
  return images_now;
}

void StereoCameras::expose(const Exposure& exposure) {
  Flight flight;
  const ToolPose& shown = exposure.displaced ? *exposure.displaced : exposure.tool;
  flight.truth = {exposure.t,
                  exposure.joints,
                  exposure.tool.tip,
                  {renderers_[0].outline(shown), renderers_[1].outline(shown)}};
  flight.stamp =
      std::max(exposure.t + timing_.stamp_delay + jitter(timing_.clock_jitter), last_stamp_ + 1e-6);
  const double arrival = exposure.t + std::max(0.0, timing_.latency + jitter(timing_.latency_jitter));
  flight.arrival = std::max({arrival, flight.stamp, last_arrival_});
  flight.blocked = exposure.blocked;
  last_stamp_ = flight.stamp;
  last_arrival_ = flight.arrival;
  if (images_) {
    ImagePair& images_now = freePair();
    for (std::size_t side = 0; side < 2; ++side) {
      renderers_[side].render(shown, images_now[side]);
      if (exposure.blocked[side]) vision::coverImage(images_now[side], exposure.t, static_cast<int>(side));
    }
    flight.left = images_now[0];
    flight.right = images_now[1];
  } else {
    flight.measured = triangulated(flight.truth, exposure.blocked);
  }
  flights_.push_back(std::move(flight));
  ++exposures_;
}

Eigen::Vector3d StereoCameras::triangulated(const FrameTruth& truth, const std::array<bool, 2>& blocked) {
  std::array<Eigen::Vector2d, 2> pixel;
  bool seen = true;
  for (std::size_t side = 0; side < 2; ++side) {
    const double du = pixels_.normal(), dv = pixels_.normal();
    pixel[side] = truth.marker[side].ellipse_centre + timing_.pixel_sigma * Eigen::Vector2d(du, dv);
    seen &= truth.marker[side].in_view && !blocked[side];
  }
  if (!seen) return nowhere();
  const double sigma = std::max(timing_.pixel_sigma, kLeastSigma);
  const vision::Triangulation found = triangulator_.triangulate(pixel[0], pixel[1], sigma, sigma);
  return found.found() ? found.position : nowhere();
}

bool StereoCameras::deliver(double now, tracking::Sample& out) {
  if (flights_.empty() || flights_.front().arrival > now) return false;
  Flight& flight = flights_.front();
  delivered_ = flight.truth;
  if (images_)
    out = tracking::StereoFrame{flight.stamp, flight.arrival, std::move(flight.left), std::move(flight.right),
                                0.0,          flight.blocked};
  else
    out = tracking::TipSample{flight.stamp, flight.arrival, registration_ * flight.measured};
  flights_.erase(flights_.begin());
  return true;
}

Eigen::Isometry3d StereoCameras::registerAtRest(const ToolPose& tool, const Eigen::Isometry3d& nominal,
                                                const Eigen::Vector3d& marker_in_base, int frames) {
  std::vector<Eigen::Vector3d> points;
  tracking::StereoTip finder(triangulator_.rig(), vision::MarkerOptions{}, true);
  const Eigen::Vector3d expected = nominal.inverse() * marker_in_base;
  const FrameTruth truth{0.0, {}, tool.tip, {renderers_[0].outline(tool), renderers_[1].outline(tool)}};
  tracking::StereoFrame frame;
  for (int i = 0; i < frames; ++i) {
    if (!images_) {
      const Eigen::Vector3d point = triangulated(truth, {});
      if (point.allFinite()) points.push_back(point);
      continue;
    }
    renderers_[0].render(tool, frame.left);
    renderers_[1].render(tool, frame.right);
    finder.find(frame, expected);
    if (finder.gate() != tracking::Gate::kOpen) continue;
    const vision::Triangulation found = finder.triangulate();
    if (found.found()) points.push_back(found.position);
  }
  const auto registered = vision::registerAtHardStop(points, nominal.linear(), marker_in_base);
  if (!registered || 2 * static_cast<int>(points.size()) < frames)
    throw base::InputError({"registration", 0, "hard stop",
                            std::to_string(points.size()) + " of " + std::to_string(frames) + " frames",
                            "show the marker too seldom",
                            "Choose a truth with more light, or a rig that sees the hard stop"});
  return registered->base_from_camera;
}

}  // namespace capstan::simulation
