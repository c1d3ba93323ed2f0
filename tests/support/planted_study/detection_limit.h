#pragma once

#include <vector>

namespace capstan::study {

/// Was an effect of this size found?
struct Trial {
  double size = 0.0;
  bool found = false;
};

/// Size at which half of all are found.
struct DetectionLimit {
  enum class Kind {
    kWithin,  ///< `size`, somewhere in low … high
    kBelow,   ///< the smallest tried, `size`, is found by half already
    kAbove,   ///< even of the largest tried, `size`, less than half are found
    kTooFew,  ///< fewer than kFewestTrials: nothing is said
  };
  Kind kind = Kind::kTooFew;
  double size = 0.0, low = 0.0, high = 0.0;
};
inline constexpr std::size_t kFewestTrials = 6;

/// From the share found as a rising function of size: isotonic regression (pool adjacent violators; Ayer et
/// al., Ann. Math. Statist. 26, 1955). Between the last size of the step below one half (`low`) and the first
/// of the step above (`high`) the limit is their geometric mean; of a step at one half the geometric mean of
/// its ends.
DetectionLimit detectionLimit(std::vector<Trial> trials);

}  // namespace capstan::study
