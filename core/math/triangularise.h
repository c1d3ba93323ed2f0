#pragma once

#include <Eigen/Core>

#include "core/math/instruction_set.h"

namespace capstan::math {

/// Number whose multiples the columns of a stacked array are padded to. The padding must be zero.
inline constexpr int kArrayLanes = 8;
constexpr int paddedColumns(int columns) { return (columns + kArrayLanes - 1) / kArrayLanes * kArrayLanes; }

/// Array with `Rows` rows and at least `Columns` columns; each row is contiguous and aligned for the kernels.
template <int Rows, int Columns>
using StackedArray = Eigen::Matrix<double, Rows, paddedColumns(Columns), Eigen::RowMajor>;

/// Computes the lower triangular L (row-major, rows×rows, diagonal >= 0, zeros above) with L Lᵀ = A Aᵀ,
/// without forming A Aᵀ. A is row-major, rows×columns, 64-byte aligned, and is overwritten; columns is a
/// multiple of kArrayLanes and <= 40. The method is modified Gram–Schmidt on the rows; its triangular factor
/// is as backward stable as Householder's (Björck and Paige, SIAM J. Matrix Anal. Appl. 13, 1992). A row that
/// depends linearly on the rows above it gives a zero on the diagonal. No allocation; cannot fail; non-finite
/// input gives non-finite output.
using TriangulariseKernel = void (*)(double* a, int rows, int columns, double* lower);

/// Kernel for the instruction set `set`, which must be available.
TriangulariseKernel triangulariseKernel(InstructionSet set);

/// Computes the lower triangular square root of `a` aᵀ with the widest available kernel; `a` is overwritten.
/// Columns <= 40.
template <int Rows, int Columns>
void triangularise(Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>& a,
                   Eigen::Matrix<double, Rows, Rows, Eigen::RowMajor>& lower) {
  static_assert(Columns % kArrayLanes == 0 && Columns <= 40, "declare the array as a StackedArray");
  static const TriangulariseKernel kernel = triangulariseKernel(bestInstructionSet());
  kernel(a.data(), Rows, Columns, lower.data());
}

}  // namespace capstan::math
