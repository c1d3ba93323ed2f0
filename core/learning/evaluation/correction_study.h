#pragma once

#include <array>
#include <vector>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/base/table.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/evaluation/stated_errors.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"

/// Table I of the GPR paper for any recording of tip poses: errors of corrected poses relative to commanded
/// poses, on trajectories held out.
namespace capstan::learning {

/// Correction methods: the six of the paper, then four of Capstan.
enum class CorrectionMethod {
  kUncorrected,
  kOffset,
  kOffsetCleaning,
  kProcess,
  kProcessVelocity,
  kAll,
  kHistory,
  kMatern,
  kWeights,
  kCommittee
};
inline constexpr std::size_t kPaperMethods = 6, kCorrectionMethods = 10;

struct CorrectionStudyOptions {
  int splits = 10;          ///< number of random splits, by trajectory
  double test_share = 0.2;  ///< share of the trajectories that is held out
  learning::CleaningOptions cleaning;
  learning::CorrectionOptions correction;
  std::uint64_t seed = 1;
};

/// Share of the mean square error that changes from one observation of a trajectory to the next, ½ E|e' − e|²
/// / E|e|². It is about 1 for white noise, which no correction can predict, and about 0 for errors that are
/// constant over many observations.
struct ErrorJitter {
  double distance = 0.0, angle = 0.0;
};

struct CorrectionStudyReport {
  /// Errors by method, on all test states and on those that cleaning accepts; pooled over the splits.
  std::array<CorrectionErrors, kCorrectionMethods> dirty{}, clean{};
  std::array<std::vector<double>, kCorrectionMethods> distances,
      angles;                                           ///< errors of each clean test state [m], [rad]
  std::vector<std::vector<CorrectionErrors>> by_split;  ///< errors of the last method: [split][dirty, clean]
  StatedErrors stated;                                  ///< of the last method, on clean states
  ErrorJitter jitter;                                   ///< of the last method, on clean states
  bool cancelled = false;
};

/// For each split, training trajectories are cleaned (and weighted), and an offset and a model are learned
/// from them as each method requires. The result is the errors
///     F(x_observed) ⊖ p_commanded
/// of the test trajectories (PoseErrors, relative to the mean of all commanded rotations). Clean test states
/// are those that pass the limits and the least median of squares found in the training data.
CorrectionStudyReport correctionStudy(const std::vector<learning::State>& states,
                                      const CorrectionStudyOptions& options,
                                      base::Progress* progress = nullptr);

/// One cell of the paper's table: mean and standard deviation [mm, deg]. PaperTable is [method][degree of
/// freedom].
struct PaperCell {
  double mean = 0.0, deviation = 0.0;
};
using PaperTable = std::array<std::array<PaperCell, 6>, kPaperMethods>;
const PaperTable& paperDirty();
const PaperTable& paperClean();

/// Table of the results `ours` beside those of the paper, one row per degree of freedom, one column per
/// method.
base::Table correctionTable(const std::array<CorrectionErrors, kCorrectionMethods>& ours,
                            const PaperTable& paper, std::string title);

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::CorrectionMethod> {
  using M = capstan::learning::CorrectionMethod;
  static constexpr std::array value = {std::pair{M::kUncorrected, "no correction"},
                                       std::pair{M::kOffset, "fixed offset"},
                                       std::pair{M::kOffsetCleaning, "offset, cleaning"},
                                       std::pair{M::kProcess, "offset, GP"},
                                       std::pair{M::kProcessVelocity, "offset, GP, velocity"},
                                       std::pair{M::kAll, "offset, GP, velocity, cleaning"},
                                       std::pair{M::kHistory, "… and history"},
                                       std::pair{M::kMatern, "… and Matérn kernel"},
                                       std::pair{M::kWeights, "… and weights"},
                                       std::pair{M::kCommittee, "… and a committee"}};
};

template <>
struct capstan::base::KeysOf<capstan::learning::CorrectionMethod> {
  using M = capstan::learning::CorrectionMethod;
  static constexpr std::array value = {std::pair{M::kUncorrected, "none"},
                                       std::pair{M::kOffset, "offset"},
                                       std::pair{M::kOffsetCleaning, "offset_cleaning"},
                                       std::pair{M::kProcess, "gp"},
                                       std::pair{M::kProcessVelocity, "gp_velocity"},
                                       std::pair{M::kAll, "gp_velocity_cleaning"},
                                       std::pair{M::kHistory, "history"},
                                       std::pair{M::kMatern, "matern"},
                                       std::pair{M::kWeights, "weights"},
                                       std::pair{M::kCommittee, "committee"}};
};
