#include "core/tracking/cable_arm_kernel.h"

#include "core/base/check.h"

namespace capstan::tracking {

#define CAPSTAN_DECLARE_KERNEL(isa)                                                                          \
  namespace detail {                                                                                         \
  void propagateCableArm##isa(const CableArmConstants&, const CableArmDrive&, double, int, double*);         \
  void propagateCableArmVaried##isa(const CableArmConstants&, const CableArmVariation&,                      \
                                    const CableArmDrive&, double, int, double*);                             \
  void propagateCableArmUnknown##isa(const CableArmConstants&, const CableArmUnknown&, const CableArmDrive&, \
                                     double, int, double*);                                                  \
  void cableArmElementary##isa(const double*, double*, double*, double*, double*);                           \
  }                                                                                                          \
  namespace {                                                                                                \
  constexpr CableArmKernel kKernel##isa = {                                                                  \
      detail::propagateCableArm##isa, detail::propagateCableArmVaried##isa,                                  \
      detail::propagateCableArmUnknown##isa, detail::cableArmElementary##isa};                               \
  }

CAPSTAN_DECLARE_KERNEL(Baseline)
#ifdef CAPSTAN_X86_KERNELS
CAPSTAN_DECLARE_KERNEL(Avx2)
CAPSTAN_DECLARE_KERNEL(Avx512)
#endif
#undef CAPSTAN_DECLARE_KERNEL

const CableArmKernel& cableArmKernel(math::InstructionSet set) {
  CAPSTAN_CHECK(math::isAvailable(set));
#ifdef CAPSTAN_X86_KERNELS
  if (set == math::InstructionSet::kAvx512) return kKernelAvx512;
  if (set == math::InstructionSet::kAvx2) return kKernelAvx2;
#endif
  (void)set;
  return kKernelBaseline;
}

}  // namespace capstan::tracking
