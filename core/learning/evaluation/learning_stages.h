#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/model/learn.h"

/// Stages of preparing training states from tables of tip poses, with the results of each stage (GPR paper,
/// section IV).
namespace capstan::learning {

/// Speed of the observed poses: median and 99 % quantile.
struct SpeedSummary {
  double median = 0.0, high = 0.0;
};

/// States of one trajectory: indices [begin, end) of all states.
struct TrajectoryStates {
  std::size_t motion = 0, begin = 0, end = 0;
  std::size_t rejected = 0;
  std::size_t states() const { return end - begin; }
};

/// Training states of a correction, and the results of each stage.
struct LearningStages : PreparedStates {
  learning::StreamKind towards = learning::StreamKind::kCommand;
  std::size_t unpaired = 0;               ///< number of observations without a commanded pose
  SpeedSummary speed, rotation_rate;      ///< [m/s], [rad/s]
  learning::CleaningReport cleaning;      ///< cleaning of the states
  std::vector<TrajectoryStates> motions;  ///< motions that have states, in their order
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid offset of all inliers
  CorrectionErrors before, after;  ///< errors of the inliers without and with the offset
};

/// Screens rows, pairs poses by the clock offset, differentiates, cleans, and removes the rigid offset.
/// Throws base::InputError as learning::prepare() and learning::checkRelated(), and if too few poses have the
/// same times as the cameras' poses.
LearningStages learningStages(const std::vector<learning::RawMotion>& motions, const LearningOptions& options,
                              base::Progress* progress = nullptr);

/// CSV of all excluded rows and states, one per line: trajectory, stream, line of its table, reason.
std::string rejectedCsv(const LearningStages& stages);

}  // namespace capstan::learning
