#include "core/math/instruction_set.h"

#include <cstdlib>
#include <string>

#include "core/base/error.h"

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

namespace {

InstructionSet requestedInstructionSet(const std::string& name) {
  for (const InstructionSet set : kInstructionSets)
    if (name == nameOf(set) && isAvailable(set)) return set;
  throw base::InputError({{},
                          0,
                          "CAPSTAN_INSTRUCTION_SET",
                          name,
                          "is no instruction set of this program and processor",
                          "Set it to baseline, AVX2+FMA or AVX-512, or remove it from the environment"});
}

}  // namespace

InstructionSet bestInstructionSet() {
  static const InstructionSet best = [] {
    const char* requested = std::getenv("CAPSTAN_INSTRUCTION_SET");
    if (requested != nullptr) return requestedInstructionSet(requested);
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
