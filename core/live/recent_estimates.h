#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "core/tracking/snapshot.h"

namespace capstan::live {

/// The filter's estimates of the last half second of motor samples. An image is older than the newest
/// estimate by the latency of its camera: what is drawn over it is the estimate of its time of exposure.
class RecentEstimates {
 public:
  struct Estimate {
    double t;  ///< [s]
    Eigen::Vector3d q, tip;
    Eigen::Matrix3d tip_covariance;
  };

  void add(const tracking::Snapshot& s) {
    ring_[next_] = {s.t, s.q_link_ukf, s.tip_ukf, s.tip_ukf_covariance};
    next_ = (next_ + 1) % ring_.size();
    if (count_ < ring_.size()) ++count_;
  }
  void clear() { next_ = count_ = 0; }

  /// The newest estimate that is not after `t`; else the oldest one. Null: there is none.
  const Estimate* at(double t) const {
    const Estimate* found = nullptr;
    for (std::size_t back = 1; back <= count_; ++back) {
      found = &ring_[(next_ + ring_.size() - back) % ring_.size()];
      if (found->t <= t) return found;
    }
    return found;
  }
  const Estimate* newest() const {
    return count_ ? &ring_[(next_ + ring_.size() - 1) % ring_.size()] : nullptr;
  }

 private:
  std::array<Estimate, 512> ring_;
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace capstan::live
