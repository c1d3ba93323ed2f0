#pragma once

#include <Eigen/Core>

#include "core/math/instruction_set.h"

namespace capstan::math {

/// Columns of a stacked array are padded to a multiple of this; the padding must be zero.
inline constexpr int kArrayLanes = 8;
constexpr int paddedColumns(int columns) { return (columns + kArrayLanes - 1) / kArrayLanes * kArrayLanes; }

/// A stack of `Rows` rows and at least `Columns` columns, each row contiguous and aligned for the kernels.
template <int Rows, int Columns>
using StackedArray = Eigen::Matrix<double, Rows, paddedColumns(Columns), Eigen::RowMajor>;

/// Lower triangular L (row-major rows×rows, diagonal >= 0, zeros above) with L Lᵀ = A Aᵀ, for A row-major
/// rows×columns, 64-byte aligned, columns <= 40 a multiple of kArrayLanes; A is overwritten. Modified
/// Gram–Schmidt on the rows, whose triangular factor is as backward stable as Householder's (Björck and
/// Paige, SIAM J. Matrix Anal. Appl. 13, 1992), without ever forming A Aᵀ. A row that depends on those above
/// gives a zero on the diagonal; no allocation, no failure; non-finite in, non-finite out.
using TriangulariseKernel = void (*)(double* a, int rows, int columns, double* lower);

/// The kernel for `set`, which must be available.
TriangulariseKernel triangulariseKernel(InstructionSet set);

/// Square root of a stacked array with the widest available kernel; `a` is overwritten. Columns <= 40.
template <int Rows, int Columns>
void triangularise(Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>& a,
                   Eigen::Matrix<double, Rows, Rows, Eigen::RowMajor>& lower) {
  static_assert(Columns % kArrayLanes == 0 && Columns <= 40, "declare the array as a StackedArray");
  static const TriangulariseKernel kernel = triangulariseKernel(bestInstructionSet());
  kernel(a.data(), Rows, Columns, lower.data());
}

}  // namespace capstan::math
