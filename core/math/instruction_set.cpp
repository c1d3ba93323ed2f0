#include "core/math/instruction_set.h"

namespace capstan::math {

bool isAvailable(InstructionSet set) {
#ifdef CAPSTAN_X86_KERNELS
  switch (set) {
    case InstructionSet::kBaseline:
      return true;
    case InstructionSet::kAvx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case InstructionSet::kAvx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && isAvailable(InstructionSet::kAvx2);
  }
  return false;
#else
  return set == InstructionSet::kBaseline;
#endif
}

InstructionSet bestInstructionSet() {
  static const InstructionSet best = [] {
    InstructionSet widest = InstructionSet::kBaseline;
    for (const InstructionSet set : kInstructionSets)
      if (isAvailable(set)) widest = set;
    return widest;
  }();
  return best;
}

const char* nameOf(InstructionSet set) {
  switch (set) {
    case InstructionSet::kBaseline:
      return "baseline";
    case InstructionSet::kAvx2:
      return "AVX2+FMA";
    case InstructionSet::kAvx512:
      return "AVX-512";
  }
  return "unknown";
}

}  // namespace capstan::math
