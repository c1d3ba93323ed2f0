#pragma once

#include <string_view>

namespace capstan::experiments {

/// Throws base::InputError unless low ≤ value ≤ high.
void requireOption(std::string_view name, double value, double low, double high);

}  // namespace capstan::experiments
