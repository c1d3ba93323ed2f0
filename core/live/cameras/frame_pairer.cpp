#include "core/live/cameras/frame_pairer.h"

#include <cmath>

#include "core/vision/equal_images.h"

namespace capstan::live {

void FramePairer::exclude(std::size_t side, Held* other) {
  held_[side].pop_front();
  if (other != nullptr && other->lost > 0)
    --other->lost, ++widowed_;
  else
    ++unpaired_;
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
