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

/// True parameters of a simulated recording in the order of the set, for comparison only; empty: unknown.
using TrueValues = std::vector<double>;

/// Table of the results of one or both methods: value ± σ and change from nominal, with the truth if known;
/// then what each method did, and advice.
std::string textOf(const identification::DualUkfReport* dual, const identification::BatchReport* batch,
                   const TrueValues& truth);

nlohmann::json jsonOf(const identification::DualUkfReport& report, const TrueValues& truth);
nlohmann::json jsonOf(const identification::BatchReport& report, const TrueValues& truth);

/// Paragraph on the parameters that the estimates identify, and on those that keep their values.
std::string identifiedParagraph(const std::vector<identification::Estimate>& estimates);

/// Writes the trace as CSV in SI: t, then value and standard deviation of every parameter. Throws
/// base::InputError when `path` cannot be written.
void writeTrace(const identification::DualUkfReport& report, const identification::ParameterSet& set,
                const std::filesystem::path& path);

/// Lines of text, one per estimate, in units for people (experiments::valueLine()).
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
