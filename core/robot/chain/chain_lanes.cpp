#include "core/robot/chain/chain_lanes.h"

#include "core/base/check.h"

namespace capstan::robot {

#define CAPSTAN_DECLARE_KERNEL(isa)                                                            \
  namespace detail {                                                                           \
  void simulateChain##isa(const ChainShape&, const ChainNumbers<ChainLane>&, const ChainRows&, \
                          const ChainRun&, ChainState<ChainLane>&);                            \
  }
CAPSTAN_DECLARE_KERNEL(Baseline)
CAPSTAN_DECLARE_KERNEL(Avx2)
CAPSTAN_DECLARE_KERNEL(Avx512)
#undef CAPSTAN_DECLARE_KERNEL

SimulateChain simulateChainKernel(math::InstructionSet set) {
  CAPSTAN_CHECK(math::isAvailable(set));
#ifdef CAPSTAN_X86_KERNELS
  if (set == math::InstructionSet::kAvx512) return detail::simulateChainAvx512;
  if (set == math::InstructionSet::kAvx2) return detail::simulateChainAvx2;
#endif
  (void)set;
  return detail::simulateChainBaseline;
}

}  // namespace capstan::robot
