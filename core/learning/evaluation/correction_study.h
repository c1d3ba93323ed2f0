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

/// Table I of the GPR paper on any recording of tip poses: errors of corrected poses against commanded ones,
/// on trajectories held out.
namespace capstan::learning {

/// The paper's six, and ours.
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
  int splits = 10;          ///< random ones, by trajectory
  double test_share = 0.2;  ///< of the trajectories
  learning::CleaningOptions cleaning;
  learning::CorrectionOptions correction;
  std::uint64_t seed = 1;
};

/// Share of the mean square of errors that changes from one observation of a trajectory to the next, ½ E|e' −
/// e|² / E|e|²: about 1 of white noise, which no correction can know, about 0 of what stays for many
/// observations.
struct ErrorJitter {
  double distance = 0.0, angle = 0.0;
};

struct CorrectionStudyReport {
  /// By method, on all test states and on those that cleaning keeps; pooled over the splits.
  std::array<CorrectionErrors, kCorrectionMethods> dirty{}, clean{};
  std::array<std::vector<double>, kCorrectionMethods> distances,
      angles;                                           ///< of each clean test state [m], [rad]
  std::vector<std::vector<CorrectionErrors>> by_split;  ///< of the last: [split][dirty, clean]
  StatedErrors stated;                                  ///< of the last, on clean states
  ErrorJitter jitter;                                   ///< likewise
  bool cancelled = false;
};

/// For each split: training trajectories are cleaned (and weighed), an offset and a model are learned from
/// them as each method asks, and the errors
///     F(x_observed) ⊖ p_commanded
/// of test trajectories taken (PoseErrors, from the mean of all commanded rotations). Clean test states are
/// those that the limits and least median found in the training data keep.
CorrectionStudyReport correctionStudy(const std::vector<learning::State>& states,
                                      const CorrectionStudyOptions& options,
                                      base::Progress* progress = nullptr);

/// The paper's numbers, [method][degree of freedom], mean and one standard deviation [mm, deg].
struct PaperCell {
  double mean = 0.0, deviation = 0.0;
};
using PaperTable = std::array<std::array<PaperCell, 6>, kPaperMethods>;
const PaperTable& paperDirty();
const PaperTable& paperClean();

/// Ours beside the paper's, a row a degree of freedom, a column a method.
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
