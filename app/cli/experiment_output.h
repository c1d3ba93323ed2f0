#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/experiments/published.h"
#include "core/experiments/results.h"

namespace capstan::cli {

/// Wall time of each experiment and of this command.
std::string timesText(const std::vector<experiments::Results>& done, double seconds);

/// Progress of a run that was stopped: `done` counts its trials, the last incomplete, in the folder `out`.
std::string cancelledText(const std::vector<experiments::Results>& done, const std::string& out);

/// {"experiments": {"C": {"trials": […], …}, …}, "goals": […]}, SI; no times, so that the same input gives
/// the same document.
nlohmann::json jsonOf(const std::vector<experiments::Results>& done, const experiments::Published& published);

}  // namespace capstan::cli
