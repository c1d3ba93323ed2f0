#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace capstan::stats {

/// Throws base::InputError under the name `what` when there are fewer than `least` samples (with both counts)
/// or a sample is not finite (with the 0-based index and the value of the first such sample).
void requireSamples(std::span<const double> values, std::size_t least, std::string_view what);

/// Throws the base::InputError of requireSamples() for the sample values[index].
[[noreturn]] void refuseSample(std::span<const double> values, std::size_t index, std::string_view what);

/// Throws base::InputError when `confidence` is not strictly between 0 and 1.
void requireConfidence(double confidence);

}  // namespace capstan::stats
