#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace capstan::testing {

/// What a stranger, or a program with a fault, sends to the port of a live motor side.
struct MutatedStream {
  std::string kind;                 ///< "cut", "bit flips", …
  std::vector<std::string> pieces;  ///< sent one after the other, 1 ms apart
};

/// Kinds of mutation, by their place in mutationKinds().
const std::vector<std::string>& mutationKinds();

/// Text of `rows` valid rows with the header line, 1 kHz from t = 0.
std::string validRows(int rows);

/// A mutation of validRows() of the kind `index` modulo the number of kinds.
MutatedStream mutatedStream(std::size_t index, base::Random& random);

}  // namespace capstan::testing
