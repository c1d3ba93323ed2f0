#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace capstan::tracking {

/// NIS of every joint over time: sums of (innovation / σ)² over windows of equal length. A value is
/// chi-square distributed with 1 degree of freedom where the filter's model holds. When kMost windows are
/// full, pairs of them are merged and the windows become twice as long. No allocation.
class InnovationRecord {
 public:
  static constexpr std::size_t kMost = 256;

  struct Window {
    std::int64_t index = 0;                             ///< the window begins at index × length()
    std::uint64_t count = 0;                            ///< number of camera updates
    Eigen::Vector3d squares = Eigen::Vector3d::Zero();  ///< sum of (innovation / σ)² per joint

    Eigen::Vector3d nis() const { return squares / static_cast<double>(count); }
  };

  /// Adds the innovation of a camera update at t [s]; does nothing for one that is not finite. Updates before
  /// the newest window count to that window.
  void add(double t, const Eigen::Vector3d& innovation, const Eigen::Vector3d& sigma);

  double length() const { return length_; }  ///< of a window [s]
  std::span<const Window> windows() const { return {windows_.data(), size_}; }
  std::uint64_t count() const { return count_; }
  Eigen::Vector3d nis() const;  ///< mean NIS per joint over all updates; NaN without any

 private:
  void mergePairs();

  std::array<Window, kMost> windows_{};
  std::size_t size_ = 0;
  double length_ = 1.0;
  std::uint64_t count_ = 0;
  Eigen::Vector3d squares_ = Eigen::Vector3d::Zero();
};

}  // namespace capstan::tracking
