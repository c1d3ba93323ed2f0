#include "app/cli/health_output.h"

#include <fmt/format.h>

#include "app/cli/html_text.h"

namespace capstan::cli {

using tracking::HealthCheck;
using tracking::HealthVerdict;

std::string healthText(const std::vector<HealthCheck>& checks) {
  if (checks.empty()) return {};
  std::string text = fmt::format("health         {}\n", base::nameOf(tracking::worstOf(checks)));
  for (const HealthCheck& check : checks) {
    if (check.verdict <= HealthVerdict::kPass) continue;
    text += fmt::format("               {}: {} {} (expected: {})\n", base::nameOf(check.verdict), check.name,
                        check.value, check.expected);
    text += fmt::format("                 {}\n", check.advice);
  }
  return text;
}

nlohmann::json healthJson(const std::vector<HealthCheck>& checks) {
  nlohmann::json all = nlohmann::json::array();
  for (const HealthCheck& check : checks)
    all.push_back({{"key", check.key},
                   {"name", check.name},
                   {"verdict", base::nameOf(check.verdict)},
                   {"value", check.value},
                   {"expected", check.expected},
                   {"advice", check.advice}});
  return {{"verdict", base::nameOf(tracking::worstOf(checks))}, {"checks", all}};
}

std::string healthHtml(const std::vector<HealthCheck>& checks) {
  if (checks.empty()) return {};
  std::string html = fmt::format(
      "<h2>Estimator health: {}</h2>\n<table><tr><th>Check</th><th>Verdict</th><th>Value</th>"
      "<th>Expected</th><th>Advice</th></tr>\n",
      base::nameOf(tracking::worstOf(checks)));
  for (const HealthCheck& check : checks)
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        escaped(check.name), base::nameOf(check.verdict), escaped(check.value),
                        escaped(check.expected), escaped(check.advice));
  return html + "</table>\n";
}

}  // namespace capstan::cli
