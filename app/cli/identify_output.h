#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/experiments/identified.h"
#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"

namespace capstan::cli {

/// True values of a simulated recording, in the set's order, for comparison only; empty: unknown.
using TrueValues = std::vector<double>;

/// What one method or both found: value ± σ, change from nominal, beside the truth where there is one.
std::string textOf(const identification::DualUkfReport* dual, const identification::BatchReport* batch,
                   const TrueValues& truth);

nlohmann::json jsonOf(const identification::DualUkfReport& report, const TrueValues& truth);
nlohmann::json jsonOf(const identification::BatchReport& report, const TrueValues& truth);

/// t, then value and standard deviation of every parameter, SI. Throws base::InputError when `path` cannot be
/// written.
void writeTrace(const identification::DualUkfReport& report, const identification::ParameterSet& set,
                const std::filesystem::path& path);

/// A line for each estimate, in units for people (experiments::valueLine()).
template <class Estimates>
std::vector<std::string> valueLines(const Estimates& estimates) {
  std::vector<std::string> lines;
  for (const auto& estimate : estimates) {
    const auto& parameter = estimate.parameter;
    lines.push_back(experiments::valueLine(parameter.name(), parameter.scale() * estimate.value(),
                                           parameter.scale() * estimate.valueSigma(), parameter.unit(),
                                           estimate.seen));
  }
  return lines;
}

}  // namespace capstan::cli
