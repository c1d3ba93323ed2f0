#pragma once

#include <array>

namespace capstan::math {

/// Instruction sets that the hot kernels are compiled for, each in its own translation unit.
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

inline constexpr std::array kInstructionSets = {InstructionSet::kBaseline, InstructionSet::kAvx2,
                                                InstructionSet::kAvx512};

/// Whether this program contains kernels for `set` and this processor can run them.
bool isAvailable(InstructionSet set);
/// Widest available instruction set, or the one that the environment variable CAPSTAN_INSTRUCTION_SET names
/// (baseline, AVX2+FMA or AVX-512): with the same set, processors of different kinds compute the same bits in
/// the hot kernels. Processor and variable are queried once. Throws base::InputError for a value that is no
/// such name and for a set that is not available.
InstructionSet bestInstructionSet();
/// Name of the instruction set: "baseline", "AVX2+FMA" or "AVX-512".
const char* nameOf(InstructionSet set);

}  // namespace capstan::math
