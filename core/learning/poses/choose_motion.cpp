#include "core/learning/poses/choose_motion.h"

#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

constexpr std::size_t kEach = 5;  // every kEach-th motion is held out

struct Parts {
  std::vector<State> learned, held;
  std::size_t motions = 0;
};

Parts partsOf(const std::vector<State>& states) {
  Parts parts;
  const std::vector<std::size_t> places = motionPlaces(states);
  for (std::size_t k = 0; k < states.size(); ++k) {
    parts.motions = places[k] + 1;
    (parts.motions % kEach == 0 ? parts.held : parts.learned).push_back(states[k]);
  }
  return parts;
}

/// Median residual of held-out states [m].
double leftBy(Motion motion, const Parts& parts, CorrectionOptions options, base::Progress* progress,
              const base::ProgressPart& part) {
  options.motion = motion;
  const CorrectionModel model = trialModel(parts.learned, options, progress, part);
  return stats::median(sizesOf(leftOf(model, parts.held), kLever));
}

}  // namespace

Motion chooseMotion(const std::vector<State>& states, const CorrectionOptions& options,
                    base::Progress* progress, const base::ProgressPart& part) {
  const Parts parts = partsOf(states);
  if (parts.motions < kFewestMotions || parts.learned.size() < kFewestStates) return Motion::kVelocity;
  const double velocity = leftBy(Motion::kVelocity, parts, options, progress, part.within(0.0, 0.5));
  if (progress && progress->cancelled()) return Motion::kVelocity;
  const double history = leftBy(Motion::kHistory, parts, options, progress, part.within(0.5, 1.0));
  if (progress && progress->cancelled()) return Motion::kVelocity;
  return history < (1.0 - kWorth) * velocity ? Motion::kHistory : Motion::kVelocity;
}

}  // namespace capstan::learning
