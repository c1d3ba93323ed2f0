#include "core/identification/link_kernel.h"

#include "core/base/check.h"

namespace capstan::identification {

#define CAPSTAN_DECLARE_KERNEL(isa)                                                                        \
  namespace detail {                                                                                       \
  void advanceLink##isa(const tracking::CableArmConstants&, const TangentOrder&, const MotorStep&, double, \
                        int, LinkTangents&);                                                               \
  }

CAPSTAN_DECLARE_KERNEL(Baseline)
#ifdef CAPSTAN_X86_KERNELS
CAPSTAN_DECLARE_KERNEL(Avx2)
CAPSTAN_DECLARE_KERNEL(Avx512)
#endif
#undef CAPSTAN_DECLARE_KERNEL

AdvanceLink advanceLinkKernel(math::InstructionSet set) {
  CAPSTAN_CHECK(math::isAvailable(set));
#ifdef CAPSTAN_X86_KERNELS
  if (set == math::InstructionSet::kAvx512) return detail::advanceLinkAvx512;
  if (set == math::InstructionSet::kAvx2) return detail::advanceLinkAvx2;
#endif
  (void)set;
  return detail::advanceLinkBaseline;
}

}  // namespace capstan::identification
