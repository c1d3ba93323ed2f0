#include "core/diagnosis/poses/pose_selection.h"

#include <algorithm>

#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {
namespace {

/// What an effect must bring before it is taken: a share of an axis's mean square, and a score that block bootstraps
/// leave above zero.
constexpr double kMaterialShare = 0.06;
constexpr double kLeastScore = 6.0;       // [nats]
constexpr double kHighConfidence = 0.02;  // quantile of the bootstrap that must be above zero
constexpr double kCompetitor = 0.08;      // share of draws in which another effect does better in its place

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

struct Rated {
  PoseFit fit;
  BlockSquares squares;
};

/// One effect beside those taken.
struct Trial {
  const PoseHypothesis* effect = nullptr;
  Rated rated;
  std::vector<double> gain;
  Reduction reduction;
  double share = 0.0;  ///< of draws in which it is the best of its round
};

class Rounds {
 public:
  Rounds(const PoseData& data, const std::vector<PoseHypothesis>& effects, std::uint64_t seed,
         base::Progress* progress)
      : data_(data), effects_(effects), progress_(progress), comparison_(data.blocks(), kDraws, seed) {}

  PoseSelection run() {
    PoseSelection s;
    s.base = fitPoses(data_, {}, {});
    Rated best = rated(s.base);
    for (int round = 1; !cancelled(progress_); ++round) {
      const auto share = static_cast<double>(round - 1) / static_cast<double>(effects_.size() + 1);
      if (progress_) progress_->report(share, "Weighing effects");
      std::vector<Trial> trials = trialsOf(best);
      note(s, trials, round);
      if (trials.empty() || !isMaterial(trials.front())) break;
      s.taken.push_back({*trials.front().effect, 0.0, {}, {}});
      best = std::move(trials.front().rated);
    }
    dropSuperfluous(s, best);
    for (PoseTaken& taken : s.taken) weigh(taken, best);
    s.best = std::move(best.fit);
    return s;
  }

 private:
  Rated rated(PoseFit fit) const {
    BlockSquares squares = squaresOf(data_, heldOut(data_, fit));
    return {std::move(fit), std::move(squares)};
  }

  Trial trialOf(const Rated& from, const PoseHypothesis& effect) const {
    Trial trial{&effect, rated(with(data_, from.fit, effect)), {}, {}, 0.0};
    trial.gain = comparison_.gain(from.squares, trial.rated.squares);
    trial.reduction = largestReduction(from.squares, trial.rated.squares);
    return trial;
  }

  static bool isMaterial(const Trial& trial) {
    return trial.reduction.share > kMaterialShare && trial.gain.front() > kLeastScore &&
           lowerOf(trial.gain, kHighConfidence) > 0.0;
  }

  /// All that are not in yet, the best first.
  std::vector<Trial> trialsOf(const Rated& best) const {
    std::vector<Trial> trials;
    for (const PoseHypothesis& effect : effects_)
      if (best.fit.placeOf(effect.name) < 0 && !cancelled(progress_)) trials.push_back(trialOf(best, effect));
    std::stable_sort(trials.begin(), trials.end(),
                     [](const Trial& a, const Trial& b) { return a.gain.front() > b.gain.front(); });
    for (std::size_t d = 1; d <= kDraws && !trials.empty(); ++d)
      std::max_element(trials.begin(), trials.end(), [d](const Trial& a, const Trial& b) {
        return a.gain[d] < b.gain[d];
      })->share += 1.0 / kDraws;
    return trials;
  }

  static void note(PoseSelection& s, const std::vector<Trial>& trials, int round) {
    for (const Trial& trial : trials)
      s.candidates.push_back({std::string(trial.effect->name), 0, round, trial.reduction.share, true,
                              trial.reduction.share, trial.gain.front(), trial.share});
  }

  /// The model without an effect, and what that effect brings back.
  Trial lossOf(const Rated& best, const PoseHypothesis& effect, Rated& less) const {
    less = rated(without(data_, best.fit, effect.name));
    return {&effect,
            {},
            comparison_.gain(less.squares, best.squares),
            largestReduction(less.squares, best.squares),
            0.0};
  }

  void dropSuperfluous(PoseSelection& s, Rated& best) const {
    for (std::size_t k = 0; k + 1 < s.taken.size() && !cancelled(progress_);) {
      Rated less;
      if (isMaterial(lossOf(best, s.taken[k].effect, less))) {
        ++k;
        continue;
      }
      best = std::move(less);
      s.taken.erase(s.taken.begin() + static_cast<std::ptrdiff_t>(k));
      k = 0;
    }
  }

  void weigh(PoseTaken& taken, const Rated& best) const {
    Rated less;
    taken.needed = 1.0 - shareBelow(lossOf(best, taken.effect, less).gain);
    for (const PoseHypothesis& effect : effects_) {
      if (best.fit.placeOf(effect.name) >= 0 || cancelled(progress_)) continue;
      const Trial instead = trialOf(less, effect);
      const double share = shareBelow(comparison_.gain(instead.rated.squares, best.squares));
      if (share <= kCompetitor || !isMaterial(instead)) continue;
      taken.competitors.push_back(effect);
      taken.shares.push_back(share);
    }
  }

  static double shareBelow(const std::vector<double>& gain) {
    return static_cast<double>(
               std::count_if(gain.begin() + 1, gain.end(), [](double g) { return g <= 0.0; })) /
           static_cast<double>(kDraws);
  }

  const PoseData& data_;
  const std::vector<PoseHypothesis>& effects_;
  base::Progress* progress_;
  Comparison comparison_;
};

}  // namespace

PoseSelection selectPoses(const PoseData& data, const std::vector<PoseHypothesis>& effects,
                          std::uint64_t seed, base::Progress* progress) {
  return Rounds(data, effects, seed, progress).run();
}

}  // namespace capstan::diagnosis
