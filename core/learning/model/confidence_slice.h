#pragma once

#include <array>
#include <vector>

#include "core/base/progress.h"
#include "core/learning/model/correction_model.h"

/// Confidence of a correction over a plane of the workspace.
namespace capstan::learning {

struct SliceOptions {
  int axis = 2;          ///< that the plane is across: 0 x, 1 y, 2 z
  double depth = 0.5;    ///< of the plane between the lowest and the highest position learned
  int cells = 48;        ///< along the longer side
  double margin = 0.02;  ///< around what was learned [m]
  double near = 0.005;   ///< of the plane: positions within are marked [m]
};

/// Positions are commanded ones: observed ones less the rigid offset.
struct ConfidenceSlice {
  int axis = 2, right = 0, up = 1;       ///< axes of the plane
  double at = 0.0;                       ///< where the plane is, along `axis` [m]
  Eigen::Vector2d low, high;             ///< centres of the first and of the last cell [m]
  Eigen::MatrixXd confidence;            ///< a row each step up, a column each step right
  double near = 0.0;                     ///< SliceOptions::near [m]
  std::vector<Eigen::Vector2d> learned;  ///< within that of the plane [m]
  bool cancelled = false;
};

/// Corrected::confidence at rest, in the orientation that is the middle of those learned.
ConfidenceSlice confidenceSlice(const CorrectionModel& model, const std::vector<State>& learned,
                                const SliceOptions& options, base::Progress* progress = nullptr);

}  // namespace capstan::learning
