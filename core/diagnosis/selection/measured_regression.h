#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Linear regression of a joint encoder on measured columns, evaluated on held-out blocks. It is the simple
/// method with which a model of physical effects is compared.
struct MeasuredRegression {
  double mean_square = 0.0;  ///< mean square of held-out residuals [unit²]; NaN: too few columns or samples
  std::vector<std::string> columns;  ///< columns of the regression with the smallest mean square
};

/// Best of several regressions by least squares. They use the first one, two, … of these columns, with the
/// constant at most kMostColumns: motor positions of all joints (own joint first), the joint's load,
/// direction of motion, load × direction, motor speed, motor torque. Each has a constant, or one per
/// recording, held-out ones included, if encoder zeros are free. Blocks and folds are those of heldOut().
/// There is none for rigid drives, whose positions are integrals of the torque.
MeasuredRegression measuredRegression(const FitData& data, int joint);
inline constexpr int kMostColumns = 7;

/// Mean square of the residuals y − x w on held-out folds; w by least squares on the other folds. `fold`: of
/// each row, from 0 to kFolds − 1.
double heldOutSquare(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, const std::vector<int>& fold);

}  // namespace capstan::diagnosis
