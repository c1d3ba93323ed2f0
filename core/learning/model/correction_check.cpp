#include "core/learning/model/correction_check.h"

#include <cmath>
#include <stdexcept>

#include "core/base/rigid.h"
#include "core/math/dense.h"

namespace capstan::learning {
namespace {

constexpr double kLargest = 1e15;      // of all numbers but the corners of an empty box
constexpr double kLargestLog = 100.0;  // of a kernel's logarithms

void require(bool holds, const char* what) {
  if (!holds) throw std::out_of_range(what);
}

template <class Numbers>
bool bounded(const Numbers& numbers, double largest = kLargest) {
  return (numbers.array().abs() <= largest).all();
}

/// B = I + V Λ⁻¹ Vᵀ: its Cholesky factor has a diagonal of at least 1.
void checkMember(const SparseProcessParts& member, Eigen::Index outputs) {
  constexpr double kRounding = 1e-6;
  require(member.sum.cols() == outputs, "outputs of a group");
  require(bounded(member.parameters.packed(), kLargestLog), "parameters of a kernel");
  require(bounded(member.inducing) && bounded(member.square) && bounded(member.sum), "numbers of a process");
  Eigen::MatrixXd factor = member.square;
  require(math::choleskyInPlace(factor) && (factor.diagonal().array() >= 1.0 - kRounding).all(), "matrix B");
}

}  // namespace

void checkParts(const CorrectionParts& parts) {
  constexpr Eigen::Index kOutputs[] = {1, 1, 1, 3};  // x, y, z, rotation
  constexpr double kUnit = 1e-6;
  require(base::isRigid(parts.offset.matrix()) && bounded(parts.offset.matrix()), "offset");
  require(std::abs(parts.features.middle().coeffs().norm() - 1.0) <= kUnit, "mean rotation");
  require(parts.lever > 0.0 && parts.lever <= kLargest, "lever");
  for (const Eigen::AlignedBox3d* box : {&parts.workspace, &parts.turns})
    require(box->min().allFinite() && box->max().allFinite(), "workspace");
  if (!parts.groups.empty()) {
    require(bounded(parts.middle) && bounded(parts.deviation), "mean of the features");
    require((parts.deviation.array() > 0.0).all(), "deviation of the features");
  }
  require(bounded(parts.scale) && (parts.scale.array() >= 0.0).all(), "scale");
  require(bounded(parts.inflation) && (parts.inflation.array() >= 0.0).all(), "inflation");
  require(parts.groups.empty() || parts.groups.size() == std::size(kOutputs), "groups");
  for (std::size_t group = 0; group < parts.groups.size(); ++group)
    for (const SparseProcessParts& member : parts.groups[group]) checkMember(member, kOutputs[group]);
}

}  // namespace capstan::learning
