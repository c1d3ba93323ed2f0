#include "core/experiments/require_option.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace capstan::experiments {

void requireOption(std::string_view name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw base::InputError({"options", 0, std::string(name), fmt::format("{}", value), "is out of range",
                          fmt::format("Give a number from {} to {}", low, high)});
}

}  // namespace capstan::experiments
