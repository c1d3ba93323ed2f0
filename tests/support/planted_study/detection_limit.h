#pragma once

#include <vector>

namespace capstan::study {

/// One trial: the size of an effect, and whether it was found.
struct Trial {
  double size = 0.0;
  bool found = false;
};

/// Size at which half of all effects are found.
struct DetectionLimit {
  enum class Kind {
    kWithin,  ///< the limit is `size`, between low and high
    kBelow,   ///< at least half are found at the smallest size tried, which is `size`
    kAbove,   ///< less than half are found at the largest size tried, which is `size`
    kTooFew,  ///< fewer than kFewestTrials trials: no limit
  };
  Kind kind = Kind::kTooFew;
  double size = 0.0, low = 0.0, high = 0.0;
};
inline constexpr std::size_t kFewestTrials = 6;

/// Detection limit by isotonic regression of the detection rate, a rising step function of size (pool
/// adjacent violators; Ayer et al., Ann. Math. Statist. 26, 1955). `low` is the last size of the step below
/// one half, `high` the first size of the step above; the limit is their geometric mean. For a step at
/// exactly one half, it is the geometric mean of the ends of the step.
DetectionLimit detectionLimit(std::vector<Trial> trials);

}  // namespace capstan::study
