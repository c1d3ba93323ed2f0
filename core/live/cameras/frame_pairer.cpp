#include "core/live/cameras/frame_pairer.h"

#include <cmath>
#include <cstring>

namespace capstan::live {

bool FramePairer::equalsLast(int side, const cv::Mat& image) const {
  const cv::Mat& last = last_[static_cast<std::size_t>(side)];
  return last.size() == image.size() && last.type() == image.type() && last.isContinuous() &&
         image.isContinuous() && std::memcmp(last.data, image.data, image.total() * image.elemSize()) == 0;
}

std::optional<FramePair> FramePairer::add(int side, double t, const cv::Mat& image) {
  const auto own = static_cast<std::size_t>(side), other = 1 - own;
  frozen_ += is_frozen_[own] = equalsLast(side, image);
  last_[own] = image;
  unpaired_ += held_[own].has_value();
  held_[own] = Held{t, image};
  if (!held_[other]) return {};
  if (std::abs(held_[other]->t - t) > tolerance_) {
    // Times of a side rise: the older one of the two has missed its partner.
    held_[held_[other]->t < t ? other : own].reset();
    ++unpaired_;
    return {};
  }
  FramePair pair{0.5 * (held_[0]->t + held_[1]->t), held_[0]->image, held_[1]->image,
                 held_[1]->t - held_[0]->t};
  held_[0].reset(), held_[1].reset();
  return pair;
}

}  // namespace capstan::live
