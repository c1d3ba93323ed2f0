#pragma once

#include <Eigen/Core>
#include <QColor>

namespace capstan::widgets {

/// Colour scale of a cable force gamma [N]: diverging from −limit (blue: against positive joint motion) over
/// grey to +limit (orange: towards it). The limit is a round number above the largest value so far.
class TensionScale {
 public:
  /// Increases the limit to the next of 1, 2, 5 × 10^k above the largest |tension|. Only reset() decreases
  /// it.
  void include(const Eigen::Vector3d& tension);
  void reset() { limit_ = 5.0; }
  double limit() const { return limit_; }
  QColor colour(double tension) const;

 private:
  double limit_ = 5.0;  // [N]
};

}  // namespace capstan::widgets
