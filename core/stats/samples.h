#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace capstan::stats {

/// At least `least` samples, all finite, or base::InputError under the name `what`: with the two counts, or
/// with the index (0-based) and value of the first sample that is not finite.
void requireSamples(std::span<const double> values, std::size_t least, std::string_view what);

/// Throws what requireSamples throws of values[index].
[[noreturn]] void refuseSample(std::span<const double> values, std::size_t index, std::string_view what);

/// A probability strictly between 0 and 1, or base::InputError.
void requireConfidence(double confidence);

}  // namespace capstan::stats
