#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

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

/// The robot file of `identified`, a comment on top saying what differs from `nominal`. Throws
/// base::InputError when `path` cannot be written.
void writeIdentifiedRobot(const robot::Description& nominal, const robot::Description& identified,
                          const std::string& path);

}  // namespace capstan::cli
