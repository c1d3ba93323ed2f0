#include <fmt/format.h>

#include "core/base/units.h"
#include "core/experiments/debridement_study.h"

namespace capstan::experiments {
namespace {

using base::toMillimetres;

/// Table II of the paper: mean and standard deviation of x, y, z [mm].
struct PaperArrival {
  std::array<double, 3> mean, deviation;
};
constexpr std::array<PaperArrival, learning::kCorrectionModes> kPaperArrival = {{
    {{20.3, 13.0, 22.8}, {0.8, 2.5, 2.9}},  // no correction
    {{2.0, 3.0, 1.0}, {0.9, 1.0, 0.7}},     // end point
    {{1.5, 4.9, 2.4}, {1.1, 1.5, 1.4}},     // full trajectory
}};
constexpr double kPaperSpeedup = 3.8, kPaperTime = 15.8;  // section V-D; time per fragment [s]

std::string cell(double mean, double deviation) { return fmt::format("{:.2f} ± {:.2f}", mean, deviation); }

std::string range(const stats::Interval& interval, int digits, double scale = 1.0) {
  return fmt::format("{:.{}f} to {:.{}f}", scale * interval.low, digits, scale * interval.high, digits);
}

double paperNorm(const PaperArrival& paper) {
  return Eigen::Vector3d(paper.mean[0], paper.mean[1], paper.mean[2]).norm();
}

std::string paperTime(DebridementMethod method) {
  if (method == DebridementMethod::kReplanning) return fmt::format("{:.0f}", kPaperSpeedup * kPaperTime);
  return method == DebridementMethod::kCorrected ? fmt::format("{:.1f}", kPaperTime) : "";
}

/// Table with one row per method.
base::Table methodsTable(std::string title,
                         const std::array<std::vector<FragmentRun>, kDebridementMethods>& runs, bool paper) {
  base::Table table;
  table.title = std::move(title);
  for (const char* name : {"", "speed [cm/s]", "time a fragment [s]", "95 %", "paper", "moving [s]",
                           "observations", "jaws off [mm]", "grasped", "cleared", "95 % [%]", "out of reach"})
    table.columns.push_back({.name = name, .unit = {}});
  for (std::size_t m = 0; m < runs.size(); ++m) {
    if (runs[m].empty()) continue;
    const auto method = static_cast<DebridementMethod>(m);
    const DebridementSummary s = summaryOf(runs[m]);
    const double speed = method == DebridementMethod::kReplanning ? DebridementTaskOptions::kSlow
                                                                  : DebridementTaskOptions::kFast;
    table.rows.push_back({std::string(base::nameOf(method)), fmt::format("{:.1f}", 100.0 * speed),
                          fmt::format("{:.1f}", s.time), range(s.time_interval, 1),
                          paper ? paperTime(method) : "", fmt::format("{:.1f}", s.moving),
                          fmt::format("{:.1f}", s.observations), fmt::format("{:.1f}", toMillimetres(s.off)),
                          fmt::format("{} of {}", s.grasped, s.fragments),
                          fmt::format("{} of {}", s.cleared, s.fragments), range(s.success, 1, 100.0),
                          fmt::format("{}", s.refused)});
  }
  return table;
}

}  // namespace

base::Table trainingTable(const DebridementStudyReport& report) {
  base::Table table;
  table.title = "Training";
  table.columns = {{.name = "", .unit = {}}, {.name = "ours", .unit = {}}, {.name = "paper", .unit = {}}};
  const auto row = [&](const char* name, std::string ours, const char* paper) {
    table.rows.push_back({name, std::move(ours), paper});
  };
  row("motions", fmt::format("{}", report.motions), "303");
  row("observed poses", fmt::format("{}", report.rows), "");
  row("of them no poses", fmt::format("{}", report.screened), "");
  row("states", fmt::format("{}", report.states), "24 000");
  row("kept by cleaning", fmt::format("{}", report.kept), "");
  row("cameras behind commands [ms]", fmt::format("{:.1f}", 1e3 * report.clock_offset), "");
  return table;
}

base::Table arrivalTable(const DebridementStudyReport& report) {
  constexpr std::array kNames = {"x [mm]", "y [mm]", "z [mm]"};
  base::Table table;
  table.title = "Arrival at fragments (table II)";
  table.columns.push_back({.name = "", .unit = {}});
  for (std::size_t m = 0; m < report.arrival.size(); ++m) {
    const auto mode = static_cast<learning::CorrectionMode>(m);
    table.columns.push_back({.name = std::string(base::nameOf(mode)), .unit = {}});
    table.columns.push_back({.name = "paper", .unit = {}});
  }
  for (std::size_t axis = 0; axis < kNames.size(); ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    std::vector<base::TableCell> row = {kNames[axis]};
    for (std::size_t m = 0; m < report.arrival.size(); ++m) {
      const ArrivalErrors& ours = report.arrival[m];
      row.emplace_back(cell(toMillimetres(ours.mean[k]), toMillimetres(ours.repeatability[k])));
      row.emplace_back(cell(kPaperArrival[m].mean[axis], kPaperArrival[m].deviation[axis]));
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<base::TableCell> norm = {"norm of the means [mm]"}, distance = {"distance [mm]"},
                               angle = {"angle [deg]"}, better = {"distance, times less"},
                               confidence = {"confidence"}, arrivals = {"arrivals"};
  const double uncorrected = report.arrival.front().distance, paper = paperNorm(kPaperArrival.front());
  for (std::size_t m = 0; m < report.arrival.size(); ++m) {
    const ArrivalErrors& ours = report.arrival[m];
    norm.emplace_back(fmt::format("{:.2f}", toMillimetres(ours.mean.norm())));
    norm.emplace_back(fmt::format("{:.2f}", paperNorm(kPaperArrival[m])));
    distance.emplace_back(cell(toMillimetres(ours.distance), toMillimetres(ours.distance_deviation)));
    angle.emplace_back(cell(base::toDegrees(ours.angle), base::toDegrees(ours.angle_deviation)));
    better.emplace_back(ours.distance > 0.0 ? fmt::format("{:.1f}", uncorrected / ours.distance) : "");
    better.emplace_back(fmt::format("{:.1f}", paper / paperNorm(kPaperArrival[m])));
    confidence.emplace_back(m == 0 ? "" : fmt::format("{:.2f}", ours.confidence));
    arrivals.emplace_back(fmt::format("{}", ours.arrived));
    for (auto* row : {&distance, &angle, &confidence}) row->emplace_back("");
    arrivals.emplace_back("100");
  }
  table.rows.insert(table.rows.end(), {norm, distance, better, angle, confidence, arrivals});
  table.note =
      "Axes: mean of absolute errors ± standard deviation between arrivals at one location. Distance, angle: "
      "mean "
      "± standard deviation of all arrivals. The paper's \"times less\" is that of its norm of means.";
  return table;
}

base::Table debridementTable(const DebridementStudyReport& report, const DebridementStudyOptions& options) {
  base::Table table = methodsTable("Debridement", report.runs, true);
  const Speedup speedup = report.speedup();
  if (speedup.value > 0.0)
    table.note = fmt::format(
        "The learned correction is {:.2f} times as fast as replanning, 95 % interval {}; the paper: {:.1f} "
        "times. "
        "Times in every method: detection {:.1f} s per fragment, a plan {:.1f} s, a motion of the jaws "
        "{:.1f} s, an "
        "observation {:.1f} s. Replanning observes every {:.0f} mm and until the tool is within {:.0f} mm. "
        "These "
        "values are chosen, not published.",
        speedup.value, range(speedup.interval, 2), kPaperSpeedup, DebridementTaskOptions::kFindTime,
        DebridementTaskOptions::kPlanTime, DebridementTaskOptions::kJawTime, DebridementTaskOptions::kLook,
        toMillimetres(DebridementTaskOptions::kPiece), toMillimetres(options.task.near));
  return table;
}

base::Table beyondTable(const DebridementStudyReport& report, const DebridementStudyOptions& options) {
  const std::string title =
      fmt::format("Debridement of a grid {:.0f} mm beside that of the data", toMillimetres(options.beyond));
  base::Table table = methodsTable(title, report.beyond, false);
  table.note = fmt::format("Low confidence: below {:g}.", learning::kLeastConfidence);
  return table;
}

}  // namespace capstan::experiments
