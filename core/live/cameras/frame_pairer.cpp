#include "core/live/cameras/frame_pairer.h"

#include <algorithm>
#include <cmath>

#include "core/vision/equal_images.h"

namespace capstan::live {

/// Adds the time of a pair, or of an image without a partner; `lost`: number of pairs before it of which
/// readers dropped both images.
void FramePairer::noteExposure(double t, std::uint64_t lost) {
  gaps_.credit(lost);
  gaps_.add(t);
  exposure_ = t;
}

/// Whether an image without a partner shows another exposure than the newest one. Cameras that are not
/// synchronised, beyond the tolerance, give two images of each exposure.
bool FramePairer::isNewExposure(std::size_t side, double t) const {
  constexpr double kLeastShare = 0.6;  // of the usual interval between two images of the side
  constexpr double kStep = 1.0;        // a clock that goes back by more has stepped [s]
  if (!exposure_ || t < *exposure_ - kStep) return true;
  return t - *exposure_ > kLeastShare * courses_[side].interval;
}

/// The usual interval follows shorter ones at once. An image that is missing makes a longer one: it follows
/// slowly.
void FramePairer::follow(std::size_t side, double t) {
  constexpr double kLonger = 1.5, kSlowly = 1.1;
  Course& course = courses_[side];
  const double interval = course.newest ? t - *course.newest : 0.0;
  course.newest = t;
  if (interval <= 0.0) return;
  const bool longer = course.interval > 0.0 && interval > kLonger * course.interval;
  course.interval = longer ? kSlowly * course.interval : interval;
}

void FramePairer::exclude(std::size_t side, Held* other) {
  const Held& own = held_[side].front();
  std::uint64_t both_lost = 0;
  if (other != nullptr && other->lost > 0) {
    --other->lost, ++widowed_;
    both_lost = std::min(own.lost, other->lost);
    other->lost -= both_lost;
  } else {
    ++unpaired_;
  }
  if (isNewExposure(side, own.t)) noteExposure(own.t, both_lost);
  follow(side, own.t);
  held_[side].pop_front();
}

std::optional<FramePair> FramePairer::add(int side, double t, const cv::Mat& image, std::uint64_t lost) {
  const auto own = static_cast<std::size_t>(side);
  frozen_ += is_frozen_[own] = vision::areEqual(last_[own], image);
  last_[own] = image;
  lost_ += lost;
  if (!held_[own].empty() && t <= held_[own].back().t)
    while (!held_[own].empty()) exclude(own, nullptr);
  if (held_[own].size() >= kMost) exclude(own, nullptr);
  held_[own].push_back({t, image, is_frozen_[own], lost});
  while (!held_[0].empty() && !held_[1].empty()) {
    Held &left = held_[0].front(), &right = held_[1].front();
    if (std::abs(left.t - right.t) <= tolerance_) {
      FramePair pair{0.5 * (left.t + right.t), left.image, right.image, left.frozen || right.frozen,
                     right.t - left.t};
      noteExposure(pair.t, std::min(left.lost, right.lost));
      follow(0, left.t), follow(1, right.t);
      held_[0].pop_front(), held_[1].pop_front();
      return pair;
    }
    // Times of a side rise: the older one of the two has missed its partner.
    const std::size_t older = left.t < right.t ? 0 : 1;
    exclude(older, &held_[1 - older].front());
  }
  return {};
}

}  // namespace capstan::live
