#pragma once

#include <Eigen/Core>

/// Large dense symmetric matrices by BLAS and LAPACK, several times as fast as Eigen's own beyond some
/// hundred rows. Symmetric ones are given by their lower triangle; the upper is neither read nor kept.
namespace capstan::math {

/// Threads of all calls from now on, of the whole process. 1 where the callers run side by side.
void setDenseThreads(int threads);

/// A = L Lᵀ in place, L in the lower triangle (dpotrf). False, and A spoilt: A is not positive definite.
bool choleskyInPlace(Eigen::MatrixXd& a);

/// Lower triangle of A⁻¹ from that of L, in place (dpotri).
void invertFromCholesky(Eigen::MatrixXd& l);

/// B ← L⁻¹ B (dtrsm).
void solveLower(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b);

/// B ← L⁻ᵀ B (dtrsm).
void solveLowerTransposed(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b);

/// C ← C + scale A Aᵀ, lower triangle of C (dsyrk).
void addSquare(double scale, const Eigen::MatrixXd& a, Eigen::MatrixXd& c);
/// C ← scale A Aᵀ likewise, of whatever size C was; C is not A.
void setSquare(double scale, const Eigen::MatrixXd& a, Eigen::MatrixXd& c);

/// S B, S symmetric (dsymm).
Eigen::MatrixXd timesSymmetric(const Eigen::MatrixXd& s, const Eigen::MatrixXd& b);

/// A B (dgemm); A Bᵀ where `transposed`.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, bool transposed = false);

}  // namespace capstan::math
