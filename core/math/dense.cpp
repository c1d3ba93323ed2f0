#include "core/math/dense.h"

#include <cblas.h>

#include <cstddef>

#include "core/base/check.h"
#include "core/math/blas_kernels.h"

// LAPACK functions in OpenBLAS, declared here by their Fortran names: no further header is needed.
extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrtri_(const char* uplo, const char* diagonal, const int* n, double* a, const int* lda, int* info);
void dlauum_(const char* uplo, const int* n, double* a, const int* lda, int* info);
}

namespace capstan::math {
namespace {

[[maybe_unused]] const bool kernels_chosen = (chooseBlasKernels(), true);  // before main()

int size(Eigen::Index n) { return static_cast<int>(n); }

// OpenBLAS multiplies matrices several times as fast as it solves with them. The functions below halve a
// triangular matrix [A 0; B C] until it is small, and leave most of the work to products.

/// A lower triangular matrix of n rows, column by column.
template <class Number>
struct Triangle {
  Number* data;
  int n, stride;

  int upper() const { return n / 2; }      ///< rows of A
  int lower() const { return n - n / 2; }  ///< rows of B and C
  Triangle a() const { return {data, upper(), stride}; }
  Number* b() const { return data + upper(); }
  Triangle c() const { return {b() + static_cast<std::ptrdiff_t>(upper()) * stride, lower(), stride}; }
};

Triangle<double> triangleOf(Eigen::MatrixXd& l) {
  CAPSTAN_ASSERT(l.rows() == l.cols());
  return {l.data(), size(l.rows()), size(l.rows())};
}

/// Right-hand sides, column by column.
struct Sides {
  double* data;
  int rows, columns, stride;

  Sides from(int row) const { return {data + row, rows - row, columns, stride}; }
};

/// X ← X − M Y, M being the `rows` × `columns` matrix at `m`, or its transpose.
void subtractProduct(const double* m, int stride, CBLAS_TRANSPOSE transposed, const Sides& y, int rows,
                     int columns, const Sides& x) {
  cblas_dgemm(CblasColMajor, transposed, CblasNoTrans, rows, x.columns, columns, -1.0, m, stride, y.data,
              y.stride, 1.0, x.data, x.stride);
}

/// Y ← L⁻¹ Y, or L⁻ᵀ Y.
void solve(const Triangle<const double>& l, CBLAS_TRANSPOSE transposed, const Sides& y) {
  constexpr int kSmall = 16;
  if (l.n <= kSmall || y.columns < kSmall) {
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transposed, CblasNonUnit, l.n, y.columns, 1.0, l.data,
                l.stride, y.data, y.stride);
    return;
  }
  const Sides below = y.from(l.upper());
  if (transposed == CblasNoTrans) {
    solve(l.a(), transposed, y);
    subtractProduct(l.b(), l.stride, transposed, y, l.lower(), l.upper(), below);
    solve(l.c(), transposed, below);
  } else {
    solve(l.c(), transposed, below);
    subtractProduct(l.b(), l.stride, transposed, below, l.upper(), l.lower(), y);
    solve(l.a(), transposed, y);
  }
}

/// M ← M L⁻ᵀ, M of `rows` rows and L's stride.
void solveFromRight(const Triangle<double>& l, double* m, int rows) {
  constexpr int kSmall = 16;
  if (l.n <= kSmall) {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rows, l.n, 1.0, l.data,
                l.stride, m, l.stride);
    return;
  }
  double* rest = m + static_cast<std::ptrdiff_t>(l.upper()) * l.stride;
  solveFromRight(l.a(), m, rows);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows, l.lower(), l.upper(), -1.0, m, l.stride, l.b(),
              l.stride, 1.0, rest, l.stride);
  solveFromRight(l.c(), rest, rows);
}

/// Lower Cholesky factor in place; false when the matrix is not positive definite.
bool factorise(const Triangle<double>& l) {
  constexpr int kSmall = 32;
  if (l.n <= kSmall) {
    int info = 0;
    dpotrf_("L", &l.n, l.data, &l.stride, &info);
    return info == 0;
  }
  if (!factorise(l.a())) return false;
  solveFromRight(l.a(), l.b(), l.lower());
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, l.lower(), l.upper(), -1.0, l.b(), l.stride, 1.0,
              l.c().data, l.stride);
  return factorise(l.c());
}

/// L ← L⁻¹ = [A⁻¹ 0; −C⁻¹ B A⁻¹ C⁻¹] in place.
void invert(const Triangle<double>& l) {
  constexpr int kSmall = 32;
  if (l.n <= kSmall) {
    int info = 0;
    dtrtri_("L", "N", &l.n, l.data, &l.stride, &info);
    CAPSTAN_ASSERT(info == 0);
    return;
  }
  invert(l.a());
  invert(l.c());
  cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, l.lower(), l.upper(), -1.0,
              l.data, l.stride, l.b(), l.stride);
  cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, l.lower(), l.upper(), 1.0,
              l.c().data, l.stride, l.b(), l.stride);
}

void solveTriangle(const Eigen::MatrixXd& l, Eigen::Ref<Eigen::MatrixXd> b, CBLAS_TRANSPOSE transposed) {
  CAPSTAN_ASSERT(l.rows() == l.cols() && l.rows() == b.rows());
  if (b.size() == 0) return;
  solve(Triangle<const double>{l.data(), size(l.rows()), size(l.rows())}, transposed,
        {b.data(), size(b.rows()), size(b.cols()), size(b.outerStride())});
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

bool choleskyInPlace(Eigen::MatrixXd& a) { return a.rows() == 0 || factorise(triangleOf(a)); }

void invertFromCholesky(Eigen::MatrixXd& l) {
  if (l.rows() == 0) return;
  const Triangle<double> inverse = triangleOf(l);
  invert(inverse);
  int info = 0;
  dlauum_("L", &inverse.n, inverse.data, &inverse.stride, &info);  // A⁻¹ = L⁻ᵀ L⁻¹
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
