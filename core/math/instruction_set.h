#pragma once

#include <array>

namespace capstan::math {

/// Instruction sets that the hot kernels are compiled for, each in its own translation unit.
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

inline constexpr std::array kInstructionSets = {InstructionSet::kBaseline, InstructionSet::kAvx2,
                                                InstructionSet::kAvx512};

/// Whether this program carries kernels for `set` and this processor runs them.
bool isAvailable(InstructionSet set);
/// The widest available set; asked of the processor once.
InstructionSet bestInstructionSet();
/// "baseline", "AVX2+FMA" or "AVX-512".
const char* nameOf(InstructionSet set);

}  // namespace capstan::math
