#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/model/learn.h"

/// From tables of tip poses to states that a correction can be learned from, each stage with its numbers (GPR
/// paper, section IV).
namespace capstan::learning {

/// Speed of the observed poses: median and 99 % quantile.
struct SpeedSummary {
  double median = 0.0, high = 0.0;
};

/// The states of one trajectory: [begin, end) of all.
struct TrajectoryStates {
  std::size_t motion = 0, begin = 0, end = 0;
  std::size_t rejected = 0;
  std::size_t states() const { return end - begin; }
};

/// What a correction is learned from, and what each stage found.
struct LearningStages : PreparedStates {
  learning::StreamKind towards = learning::StreamKind::kCommand;
  std::size_t unpaired = 0;                                  ///< observations without a commanded pose
  SpeedSummary speed, rotation_rate;                         ///< [m/s], [rad/s]
  learning::CleaningReport cleaning;                         ///< of the states
  std::vector<TrajectoryStates> motions;                     ///< those that have states, in their order
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid, of all states that count
  CorrectionErrors before, after;  ///< of these, as seen and with the offset taken off
};

/// Screens, pairs by the clock offset, differentiates, cleans, and removes the rigid offset.
/// base::InputError: as learning::prepare() and learning::checkRelated(); too few poses lie beside the
/// cameras'.
LearningStages learningStages(const std::vector<learning::RawMotion>& motions, const LearningOptions& options,
                              base::Progress* progress = nullptr);

/// Every row and every state that was excluded, a line each, as CSV: trajectory, stream, line of its table,
/// reason.
std::string rejectedCsv(const LearningStages& stages);

}  // namespace capstan::learning
