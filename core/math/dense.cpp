#include "core/math/dense.h"

#include <cblas.h>

#include "core/base/check.h"

// LAPACK functions in OpenBLAS, declared here by their Fortran names: no further header is needed.
extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dpotri_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace capstan::math {
namespace {

int size(Eigen::Index n) { return static_cast<int>(n); }

void solveTriangle(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b, CBLAS_TRANSPOSE transposed) {
  CAPSTAN_ASSERT(l.rows() == l.cols() && l.rows() == b.rows());
  if (b.size() == 0) return;
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transposed, CblasNonUnit, size(b.rows()), size(b.cols()),
              1.0, l.data(), size(l.rows()), b.data(), size(b.outerStride()));
}

/// C ← before C + scale A Aᵀ.
void squareInto(double scale, const Eigen::MatrixXd& a, double before, Eigen::MatrixXd& c) {
  if (c.size() == 0) return;
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, size(a.rows()), size(a.cols()), scale, a.data(),
              size(a.rows()), before, c.data(), size(c.rows()));
}

}  // namespace

void setDenseThreads(int threads) { openblas_set_num_threads(threads); }
int denseThreads() { return openblas_get_num_threads(); }

bool choleskyInPlace(Eigen::MatrixXd& a) {
  CAPSTAN_ASSERT(a.rows() == a.cols());
  const int n = size(a.rows());
  int info = 0;
  if (n > 0) dpotrf_("L", &n, a.data(), &n, &info);
  return info == 0;
}

void invertFromCholesky(Eigen::MatrixXd& l) {
  const int n = size(l.rows());
  int info = 0;
  if (n > 0) dpotri_("L", &n, l.data(), &n, &info);
  CAPSTAN_ASSERT(info == 0);
}

void solveLower(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b) {
  solveTriangle(l, b, CblasNoTrans);
}

void solveLowerTransposed(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b) {
  solveTriangle(l, b, CblasTrans);
}

void addSquare(double scale, const Eigen::MatrixXd& a, Eigen::MatrixXd& c) {
  CAPSTAN_ASSERT(c.rows() == a.rows() && c.cols() == a.rows());
  squareInto(scale, a, 1.0, c);
}

void setSquare(double scale, const Eigen::MatrixXd& a, Eigen::MatrixXd& c) {
  CAPSTAN_ASSERT(&a != &c);
  c.resize(a.rows(), a.rows());
  squareInto(scale, a, 0.0, c);
}

Eigen::MatrixXd timesSymmetric(const Eigen::MatrixXd& s, const Eigen::MatrixXd& b) {
  CAPSTAN_ASSERT(s.rows() == s.cols() && s.cols() == b.rows());
  Eigen::MatrixXd c(b.rows(), b.cols());
  if (c.size() > 0)
    cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, size(b.rows()), size(b.cols()), 1.0, s.data(),
                size(s.rows()), b.data(), size(b.rows()), 0.0, c.data(), size(c.rows()));
  return c;
}

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, bool transposed) {
  CAPSTAN_ASSERT(a.cols() == (transposed ? b.cols() : b.rows()));
  Eigen::MatrixXd c(a.rows(), transposed ? b.rows() : b.cols());
  if (a.cols() == 0) c.setZero();
  if (c.size() > 0 && a.cols() > 0)
    cblas_dgemm(CblasColMajor, CblasNoTrans, transposed ? CblasTrans : CblasNoTrans, size(c.rows()),
                size(c.cols()), size(a.cols()), 1.0, a.data(), size(a.rows()), b.data(), size(b.rows()), 0.0,
                c.data(), size(c.rows()));
  return c;
}

}  // namespace capstan::math
