#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace capstan::monitor {

/// Latencies from the publication of an image to the end of the swap that showed it; of the last kKept
/// images.
class LatencyLog {
 public:
  struct Summary {
    std::size_t count = 0;                        ///< of all images
    double median = 0.0, high = 0.0, most = 0.0;  ///< median, 99 % and largest of the last ones [s]
  };

  void add(double seconds);
  Summary summary() const;

 private:
  static constexpr std::size_t kKept = 4096;
  std::array<double, kKept> values_{};
  std::size_t count_ = 0;
};

}  // namespace capstan::monitor
