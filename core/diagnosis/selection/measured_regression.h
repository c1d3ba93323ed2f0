#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Least squares of a joint encoder on measured columns, judged on held-out blocks: what anybody would try first, and what a
/// named model must not fall behind.
struct MeasuredRegression {
  double mean_square = 0.0;          ///< of held-out residuals [unit²]; NaN: not enough columns or samples
  std::vector<std::string> columns;  ///< of the regression with the least mean square
};

/// At most kMostColumns of these, in this order, are tried in growing numbers: motor positions of all joints (own joint first),
/// the joint's load, its direction of motion, load × direction, motor speed, motor torque; always a constant, one per
/// recording where encoder zeros are free. The blocks and folds are those of heldOut(). Joints of rigid drives have none: their
/// positions are integrals of the torque.
MeasuredRegression measuredRegression(const FitData& data, int joint);
inline constexpr int kMostColumns = 7;

}  // namespace capstan::diagnosis
