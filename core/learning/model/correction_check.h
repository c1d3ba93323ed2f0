#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// Throws std::out_of_range, with what is wrong, for parts that no trained model has: numbers that are not
/// finite or beyond 1e15, an offset that is no rigid transform, a rotation that is none, deviations, scales
/// and factors that are not positive, other groups than those of x, y, z and the rotation, and a matrix B
/// without a Cholesky factor.
void checkParts(const CorrectionParts& parts);

}  // namespace capstan::learning
