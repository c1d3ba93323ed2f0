#pragma once

/// SIMD lanes for kernels, which are compiled from one source once per instruction set. Only kernel
/// translation units include this file. Everything is in an unnamed namespace, so that the linker can never
/// replace code for one instruction set by the same function for another. For the same reason neither this
/// file nor the kernels may use Eigen or the templates of the standard library.
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define CAPSTAN_KERNEL_NAME(base) base##Avx512
#define CAPSTAN_KERNEL_WIDTH 8
#elif defined(__AVX2__) && defined(__FMA__)
#define CAPSTAN_KERNEL_NAME(base) base##Avx2
#define CAPSTAN_KERNEL_WIDTH 4
#else
#define CAPSTAN_KERNEL_NAME(base) base##Baseline
#define CAPSTAN_KERNEL_WIDTH 2
#endif

namespace {  // NOLINT: one copy per translation unit is the point

inline constexpr int kWidth = CAPSTAN_KERNEL_WIDTH;
using Vec = double __attribute__((vector_size(8 * CAPSTAN_KERNEL_WIDTH)));
using Bits = long long __attribute__((vector_size(8 * CAPSTAN_KERNEL_WIDTH)));

#define CAPSTAN_INLINE [[maybe_unused, gnu::always_inline]] inline

/// Vec in memory that other code accesses as plain doubles.
using StoredVec = double __attribute__((vector_size(8 * CAPSTAN_KERNEL_WIDTH), may_alias));

CAPSTAN_INLINE Vec load(const double* p) { return *reinterpret_cast<const StoredVec*>(p); }
CAPSTAN_INLINE void store(double* p, Vec v) { *reinterpret_cast<StoredVec*>(p) = v; }
CAPSTAN_INLINE Vec splat(double v) { return v - Vec{}; }

CAPSTAN_INLINE double sumOf(Vec v) {
#if CAPSTAN_KERNEL_WIDTH == 8
  using Half = double __attribute__((vector_size(32)));
  const Half four =
      Half(__builtin_shufflevector(v, v, 0, 1, 2, 3)) + Half(__builtin_shufflevector(v, v, 4, 5, 6, 7));
  using Quarter = double __attribute__((vector_size(16)));
  const Quarter two =
      Quarter(__builtin_shufflevector(four, four, 0, 1)) + Quarter(__builtin_shufflevector(four, four, 2, 3));
  return two[0] + two[1];
#elif CAPSTAN_KERNEL_WIDTH == 4
  using Half = double __attribute__((vector_size(16)));
  const Half two = Half(__builtin_shufflevector(v, v, 0, 1)) + Half(__builtin_shufflevector(v, v, 2, 3));
  return two[0] + two[1];
#else
  return v[0] + v[1];
#endif
}

}  // namespace
