#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/stats/gap_counter.h"

namespace capstan::live {

/// Images of both cameras of one time.
struct FramePair {
  double t = 0.0;  ///< mean of the times of the two images [s]
  cv::Mat left, right;
  bool frozen = false;  ///< an image of it equals the one before
  double skew = 0.0;    ///< time of the right image minus that of the left [s]
};

/// Pairs the images of two cameras that are not synchronised, by their times. The two sides need not come in
/// turn: on a busy computer several images of one side come before those of the other.
class FramePairer {
 public:
  /// `tolerance`: largest difference of the times of a pair [s].
  explicit FramePairer(double tolerance) : tolerance_(tolerance) {}

  /// Adds an image of side 0 (left) or 1 (right) with its time [s]; times of a side rise, and where they do
  /// not, its clock has stepped and the images that wait are excluded. `lost`: number of images of this side
  /// that its reader had to drop since the one before. Returns the pair that the image completes. An image
  /// is excluded when no partner within the tolerance can come to it any more, or when kMost wait.
  std::optional<FramePair> add(int side, double t, const cv::Mat& image, std::uint64_t lost = 0);
  /// Images excluded so far since the other camera gave none at their time.
  std::uint64_t unpaired() const { return unpaired_; }
  /// Pairs that do not exist since a reader had to drop one of their images, or both.
  std::uint64_t dropped() const { return (lost_ + widowed_ + 1) / 2; }
  /// Pairs of which neither image came, by the gaps between the exposures. Pairs that are frozen, images
  /// without a partner, and pairs that readers dropped are no gap.
  std::uint64_t missing() const { return gaps_.missing(); }
  std::uint64_t frozen() const { return frozen_; }  ///< images that equal the one before, so far
  /// Whether the last image of a side equals the one before.
  bool isFrozen(int side) const { return is_frozen_[static_cast<std::size_t>(side)]; }

  static constexpr std::size_t kMost = 16;  ///< images of a side that wait for their partners

 private:
  struct Held {
    double t = 0.0;
    cv::Mat image;
    bool frozen = false;
    std::uint64_t lost = 0;  ///< images of its side that were dropped before it, and have not been missed yet
  };
  /// Excludes the oldest image of a side; `other`: the next image of the other side, if one is there.
  void exclude(std::size_t side, Held* other);
  void noteExposure(double t, std::uint64_t lost);
  bool isNewExposure(std::size_t side, double t) const;
  void follow(std::size_t side, double t);

  double tolerance_;
  std::array<std::deque<Held>, 2> held_;  ///< in order of time; one of them is empty
  std::array<cv::Mat, 2> last_;
  std::array<bool, 2> is_frozen_{};
  std::uint64_t unpaired_ = 0, frozen_ = 0;
  std::uint64_t lost_ = 0;          ///< images that readers dropped
  std::uint64_t widowed_ = 0;       ///< images whose partner was one of these
  stats::GapCounter gaps_;          ///< between the exposures
  std::optional<double> exposure_;  ///< time of the newest one [s]
  /// Of the images of a side that wait no more.
  struct Course {
    std::optional<double> newest;  ///< time of the newest one [s]
    double interval = 0.0;         ///< usual one between two of them [s]; 0: not known
  };
  std::array<Course, 2> courses_;
};

}  // namespace capstan::live
