#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/experiments/published.h"
#include "core/experiments/results.h"

namespace capstan::cli {

/// Wall time of each experiment and of this command.
std::string timesText(const std::vector<experiments::Results>& done, double seconds);

/// Notice of a stopped run: the number of finished trials of `done` that the folder `out` keeps.
std::string cancelledText(const std::vector<experiments::Results>& done, const std::string& out);

/// JSON in SI: {"experiments": {"C": {"trials": […], …}, …}, "goals": […]}. It has no computing times, so
/// that the same input gives the same document.
nlohmann::json jsonOf(const std::vector<experiments::Results>& done, const experiments::Published& published);

}  // namespace capstan::cli
