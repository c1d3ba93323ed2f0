#pragma once

#include <Eigen/Core>

/// Operations on large dense matrices by BLAS and LAPACK, which are several times as fast as Eigen's own for
/// more than some hundred rows. A symmetric matrix is given by its lower triangle; its upper triangle is
/// neither read nor preserved.
namespace capstan::math {

/// Sets the number of BLAS threads of the whole process. Use 1 when several threads call these.
void setDenseThreads(int threads);
/// That number.
int denseThreads();

/// Cholesky factor A = L Lᵀ in place, L in the lower triangle. Returns false when A is not positive
/// definite; A is then invalid.
bool choleskyInPlace(Eigen::MatrixXd& a);

/// Replaces L by the lower triangle of A⁻¹ = (L Lᵀ)⁻¹, in place.
void invertFromCholesky(Eigen::MatrixXd& l);

/// Solves B ← L⁻¹ B, L lower triangular.
void solveLower(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b);

/// Solves B ← L⁻ᵀ B, L lower triangular.
void solveLowerTransposed(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b);

/// Adds scale A Aᵀ to the lower triangle of C (dsyrk).
void addSquare(double scale, const Eigen::MatrixXd& a, Eigen::MatrixXd& c);
/// Sets the lower triangle of C to scale A Aᵀ and resizes C (dsyrk). C must not be A.
void setSquare(double scale, const Eigen::MatrixXd& a, Eigen::MatrixXd& c);

/// Product S B, S symmetric (dsymm).
Eigen::MatrixXd timesSymmetric(const Eigen::MatrixXd& s, const Eigen::MatrixXd& b);

/// Product A B, or A Bᵀ when `transposed` is true (dgemm).
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, bool transposed = false);

}  // namespace capstan::math
