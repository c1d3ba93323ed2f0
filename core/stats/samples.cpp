#include "core/stats/samples.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/base/error.h"

namespace capstan::stats {

void requireSamples(std::span<const double> values, std::size_t least, std::string_view what) {
  if (values.size() < least)
    throw base::InputError({{},
                            0,
                            std::string(what),
                            fmt::format("{} samples", values.size()),
                            fmt::format("at least {} are needed", least),
                            "Take a longer recording or a wider range of it"});
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) refuseSample(values, i, what);
}

void refuseSample(std::span<const double> values, std::size_t index, std::string_view what) {
  throw base::InputError({{},
                          0,
                          fmt::format("{}[{}]", what, index),
                          fmt::format("{}", values[index]),
                          "a sample must be a finite number",
                          "Remove the samples that have no value"});
}

void requireConfidence(double confidence) {
  if (confidence > 0.0 && confidence < 1.0) return;
  throw base::InputError({{},
                          0,
                          "confidence",
                          fmt::format("{}", confidence),
                          "must lie between 0 and 1",
                          "Give it as a share, for example 0.95"});
}

}  // namespace capstan::stats
