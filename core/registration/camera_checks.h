#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/registration/stereo_fault.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"
#include "core/vision/image_quality.h"
#include "core/vision/marker.h"

/// Checks of both cameras before a registration: images arrive, at the same time, in focus, well exposed,
/// with the marker, in the right order. Their clock is the session's.
namespace capstan::registration {

enum class CheckState {
  kUnknown,  ///< cannot be judged yet, or not with this source
  kPass,
  kFail
};

struct CameraCheck {
  std::string name;  ///< "images", "same time", "focus", "exposure", "marker", "geometry"
  CheckState state = CheckState::kUnknown;
  std::string value = {};   ///< its number, as "0.9, 1.1 px"
  std::string remedy = {};  ///< of a failed check: what is wrong, and what to do
  std::string button = {};  ///< text of the button that does it; empty: a person has to
};

/// What can be done about wrong images or cameras without touching them.
struct CameraRemedy {
  vision::ImageCorrection correction;  ///< of the images as they are now
  double scale = 1.0;                  ///< of the base line
};

/// Reason and remedy against a marker that is not found.
const char* adviceAgainst(vision::MarkerFault fault);

class CameraChecks {
 public:
  /// Largest time between the exposures of a pair [s]: at 0.1 m/s, a usual speed of a tool, the marker moves
  /// by 0.5 mm meanwhile, about the error of its depth.
  static constexpr double kLargestSkew = 0.005;
  /// Largest share of the marker's pixels with a clipped channel. Clipping changes the hue; highlights of a
  /// shiny ball clip 1 to 2 %.
  static constexpr double kMostClipped = 0.05;
  /// The same of a whole image, where windows and lamps may clip.
  static constexpr double kMostClippedImage = 0.2;
  /// Smallest median brightness of the marker, over the smallest value that the detector accepts: the side of
  /// the ball that is half as bright is then still accepted.
  static constexpr double kLeastBrightness = 2.0;

  /// `rig`: of the images; none: they cannot be compared with a calibration.
  CameraChecks(const std::optional<vision::StereoRig>& rig, const vision::MarkerOptions& marker);

  /// Takes a pair of images with its snapshot.
  void see(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot);
  /// Takes any snapshot: for the geometry, every camera update in order.
  void observe(const tracking::Snapshot& snapshot);
  /// Present time of the session [s], and the sides of a live source.
  void setNow(double t, std::vector<tracking::SideStatus> sides);
  void setMarker(const vision::MarkerOptions& marker) { marker_ = marker; }

  std::vector<CameraCheck> checks() const;
  /// Exposure of the whole left and right image, for histograms.
  const std::array<vision::Exposure, 2>& exposures() const { return image_exposure_; }
  /// What the button of the failed check does; none: there is no such check.
  std::optional<CameraRemedy> remedy() const;
  const StereoFinding* finding() const { return watch_ ? &watch_->finding() : nullptr; }

 private:
  CameraCheck images() const;
  std::optional<CameraCheck> streamFault() const;
  std::optional<CameraCheck> imageFault(std::size_t side) const;
  CameraCheck sameTime() const;
  CameraCheck focus() const;
  CameraCheck exposure() const;
  CameraCheck marker() const;
  CameraCheck geometry() const;
  std::string exposureFault(std::size_t side) const;
  bool seemExchanged() const;
  void judgeOrder(const tracking::Snapshot& snapshot);

  std::optional<StereoWatch> watch_;
  std::optional<vision::Triangulator> triangulator_;
  vision::MarkerOptions marker_;
  std::vector<tracking::SideStatus> sides_;
  double now_ = 0.0;
  double newest_ = -std::numeric_limits<double>::infinity();  ///< arrival of the newest pair [s]
  double period_ = 0.0;                                       ///< mean time between pairs [s]
  std::uint64_t samples_ = 0;
  std::optional<double> skew_;  ///< running mean of |right − left| [s]
  std::array<cv::Mat, 2> last_;
  std::array<int, 2> frozen_{};  ///< consecutive images that equal the one before
  std::array<cv::Size, 2> sizes_{};
  std::array<double, 2> blur_{};     ///< [px]
  std::array<bool, 2> at_marker_{};  ///< exposure and blur are those of the marker
  std::array<vision::Exposure, 2> image_exposure_, exposure_;
  std::array<vision::MarkerFault, 2> faults_{};
  int exchanged_ = 0, judged_ = 0;  ///< of the newest pairs with both markers, decaying
};

}  // namespace capstan::registration
