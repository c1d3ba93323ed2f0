#include "core/tracking/innovation_record.h"

#include <algorithm>
#include <cmath>

namespace capstan::tracking {

void InnovationRecord::add(double t, const Eigen::Vector3d& innovation, const Eigen::Vector3d& sigma) {
  const Eigen::Vector3d squares = innovation.cwiseQuotient(sigma).cwiseAbs2();
  if (!squares.allFinite() || !std::isfinite(t)) return;
  ++count_;
  squares_ += squares;
  auto index = static_cast<std::int64_t>(std::floor(t / length_));
  while (size_ == kMost && index > windows_[size_ - 1].index) {
    mergePairs();
    index = static_cast<std::int64_t>(std::floor(t / length_));
  }
  if (size_ == 0 || index > windows_[size_ - 1].index)
    windows_[size_++] = {index, 0, Eigen::Vector3d::Zero()};
  Window& newest = windows_[size_ - 1];
  ++newest.count;
  newest.squares += squares;
}

Eigen::Vector3d InnovationRecord::nis() const { return squares_ / static_cast<double>(count_); }

void InnovationRecord::mergePairs() {
  length_ *= 2.0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    Window window = windows_[i];
    window.index = (window.index - (window.index & 1)) / 2;
    if (kept > 0 && windows_[kept - 1].index == window.index) {
      windows_[kept - 1].count += window.count;
      windows_[kept - 1].squares += window.squares;
    } else {
      windows_[kept++] = window;
    }
  }
  size_ = kept;
}

}  // namespace capstan::tracking
