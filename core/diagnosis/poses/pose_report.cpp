#include <cmath>

#include "core/diagnosis/poses/pose_diagnosis.h"
#include "core/diagnosis/report/report_json.h"
#include "core/diagnosis/report/report_tables.h"

namespace capstan::diagnosis {

base::Table poseStepTable(const PoseReport& report) {
  constexpr double kMillimetres = 1e3;
  const auto column = [](const char* name) {
    return base::TableColumn{name, "mm", 2, base::NumberStyle::kFixed, false};
  };
  base::Table table;
  table.title = "How far the tip is off, step by step, on trajectories held out";
  table.columns = {{"with", {}, 0, base::NumberStyle::kFixed, false},
                   column("RMS"),
                   column("from"),
                   column("to"),
                   column("x"),
                   column("y"),
                   column("z"),
                   column("median")};
  for (const PoseStep& step : report.steps)
    table.rows.push_back({step.effect.empty() ? std::string("as measured") : "+ " + titleOf(step.effect),
                          kMillimetres * step.rms, kMillimetres * step.interval.low,
                          kMillimetres * step.interval.high, kMillimetres * step.axis[0],
                          kMillimetres * step.axis[1], kMillimetres * step.axis[2],
                          kMillimetres * step.median});
  table.note = "Towards the " + std::string(base::nameOf(report.towards)) + ": " +
               std::to_string(report.fitted) + " trajectories fitted, " + std::to_string(report.held_out) +
               " held out. From and to: 95 %, by a bootstrap of trajectories; x, y, z: RMS of each axis.";
  return table;
}

nlohmann::json jsonOf(const PoseReport& report) {
  using nlohmann::json;
  json all = jsonOf(report.report);
  all["towards"] = base::nameOf(report.towards);
  all["trajectories"] = {{"fitted", report.fitted}, {"held_out", report.held_out}};
  json steps = json::array();
  for (const PoseStep& step : report.steps)
    steps.push_back({{"effect", step.effect.empty() ? json() : json(step.effect)},
                     {"rms", step.rms},
                     {"interval", {step.interval.low, step.interval.high}},
                     {"axis", step.axis},
                     {"median", step.median}});
  all["steps"] = std::move(steps);
  return all;
}

}  // namespace capstan::diagnosis
