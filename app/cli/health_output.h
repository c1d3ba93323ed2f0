#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/tracking/health.h"

namespace capstan::cli {

/// Text for people: the verdict, and one line per check that does not pass, with its advice.
std::string healthText(const std::vector<tracking::HealthCheck>& checks);
/// {"verdict": …, "checks": [{"key", "name", "verdict", "value", "expected", "advice"}, …]}
nlohmann::json healthJson(const std::vector<tracking::HealthCheck>& checks);
/// HTML table of all checks, with a heading.
std::string healthHtml(const std::vector<tracking::HealthCheck>& checks);

}  // namespace capstan::cli
