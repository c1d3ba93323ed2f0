#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace capstan::live {

/// Images of both cameras of one time.
struct FramePair {
  double t = 0.0;  ///< mean of the times of the two images [s]
  cv::Mat left, right;
  double skew = 0.0;  ///< time of the right image minus that of the left [s]
};

/// Pairs the images of two cameras that are not synchronised, by their times.
class FramePairer {
 public:
  /// `tolerance`: largest difference of the times of a pair [s].
  explicit FramePairer(double tolerance) : tolerance_(tolerance) {}

  /// Adds an image of side 0 (left) or 1 (right) with its time [s]; times of a side rise. Returns the pair
  /// that it completes. An image that no partner within the tolerance can come to any more is excluded.
  std::optional<FramePair> add(int side, double t, const cv::Mat& image);
  std::uint64_t unpaired() const { return unpaired_; }  ///< images excluded so far
  std::uint64_t frozen() const { return frozen_; }      ///< images that equal the one before, so far
  /// Whether the last image of a side equals the one before.
  bool isFrozen(int side) const { return is_frozen_[static_cast<std::size_t>(side)]; }

 private:
  struct Held {
    double t = 0.0;
    cv::Mat image;
  };
  bool equalsLast(int side, const cv::Mat& image) const;

  double tolerance_;
  std::array<std::optional<Held>, 2> held_;  ///< waits for its partner
  std::array<cv::Mat, 2> last_;
  std::array<bool, 2> is_frozen_{};
  std::uint64_t unpaired_ = 0, frozen_ = 0;
};

}  // namespace capstan::live
