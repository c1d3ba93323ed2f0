#include "core/math/triangularise.h"

#include "core/base/check.h"

namespace capstan::math {

namespace detail {
void triangulariseBaseline(double* a, int rows, int columns, double* lower);
#ifdef CAPSTAN_X86_KERNELS
void triangulariseAvx2(double* a, int rows, int columns, double* lower);
void triangulariseAvx512(double* a, int rows, int columns, double* lower);
#endif
}  // namespace detail

TriangulariseKernel triangulariseKernel(InstructionSet set) {
  CAPSTAN_CHECK(isAvailable(set));
#ifdef CAPSTAN_X86_KERNELS
  if (set == InstructionSet::kAvx512) return detail::triangulariseAvx512;
  if (set == InstructionSet::kAvx2) return detail::triangulariseAvx2;
#endif
  (void)set;
  return detail::triangulariseBaseline;
}

}  // namespace capstan::math
