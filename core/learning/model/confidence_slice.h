#pragma once

#include <array>
#include <vector>

#include "core/base/progress.h"
#include "core/learning/model/correction_model.h"

/// Confidence of a correction on a plane of the workspace.
namespace capstan::learning {

struct SliceOptions {
  int axis = 2;          ///< axis perpendicular to the plane: 0 x, 1 y, 2 z
  double depth = 0.5;    ///< position of the plane, from 0 (lowest training position) to 1 (highest)
  int cells = 48;        ///< number of cells along the longer side
  double margin = 0.02;  ///< margin around the training positions [m]
};

/// Confidence on a plane. Positions are in the frame of commands: observed positions, transformed by the
/// rigid offset.
struct ConfidenceSlice {
  int axis = 2, right = 0, up = 1;       ///< axes of the plane
  double at = 0.0;                       ///< coordinate of the plane along `axis` [m]
  Eigen::Vector2d low, high;             ///< centres of the first and last cell [m]
  Eigen::MatrixXd confidence;            ///< one row per step up, one column per step right
  double near = 0.005;                   ///< largest distance of `learned` from the plane [m]
  std::vector<Eigen::Vector2d> learned;  ///< training positions within `near` of the plane [m]
  bool cancelled = false;
};

/// Slice of Corrected::confidence at rest, in the mean orientation of the training states.
ConfidenceSlice confidenceSlice(const CorrectionModel& model, const std::vector<State>& learned,
                                const SliceOptions& options, base::Progress* progress = nullptr);

}  // namespace capstan::learning
