#include "core/analysis/session_record.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/yaml.h"
#include "core/estimation/consistency.h"
#include "core/estimation/nis_verdict.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/transmission_text.h"
#include "core/vision/registration_file.h"

namespace capstan::analysis {
namespace {

using tracking::Gate;
using tracking::TrackReport;

/// Rows of the report's table: quantity, value, unit or remark.
class Rows {
 public:
  explicit Rows(std::vector<std::vector<base::TableCell>>& rows) : rows_(rows) {}
  void add(const std::string& quantity, const std::string& value, const std::string& remark = {}) {
    rows_.push_back({quantity, value, remark});
  }
  void addCount(const std::string& quantity, std::uint64_t count, const std::string& remark = {}) {
    add(quantity, fmt::format("{}", count), remark);
  }
  void addShare(const std::string& quantity, double share, const std::string& remark = {}) {
    if (!std::isnan(share)) add(quantity, fmt::format("{:.2f} %", 100.0 * share), remark);
  }

 private:
  std::vector<std::vector<base::TableCell>>& rows_;
};

void addConsistency(const TrackReport& report, Rows& rows) {
  const double nis = report.nisMean();
  if (!std::isnan(nis)) {
    const auto count = static_cast<std::int64_t>(report.gates[static_cast<std::size_t>(Gate::kOpen)]);
    const estimation::Band band = estimation::chiSquareBand(3, count);
    const auto verdict = estimation::judgeNis(nis, band.contains(nis));
    rows.add("NIS / 3", fmt::format("{:.3f}", nis),
             fmt::format("95 % band {:.3f} to {:.3f}: {}", band.low, band.high, base::nameOf(verdict)));
  }
  if (report.rays > 0)
    rows.add("NIS / 2 of one camera", fmt::format("{:.3f}", report.rayNisMean()),
             fmt::format("{} updates", report.rays));
  if (!std::isnan(report.neesMean()))
    rows.add("NEES / 3", fmt::format("{:.3f}", report.neesMean()), "positions against the reference");
}

void addFaults(const TrackReport& report, Rows& rows) {
  for (const std::string& line : tracking::linesOf(report.transmission)) rows.add("transmission", line);
  for (std::size_t i = 0; i < 3; ++i)
    if (report.motor_failed[i] != tracking::MotorFault::kNone)
      rows.add(fmt::format("encoder of motor {}", i + 1), std::string(base::nameOf(report.motor_failed[i])),
               fmt::format("since {:.3f} s", report.motor_failed_since[i]));
}

base::Table reportTable(const SessionRecord& record) {
  const TrackReport& report = record.report;
  base::Table table{record.run.title + ": report", {{"quantity", {}}, {"value", {}}, {"remark", {}}}, {}, {}};
  Rows rows(table.rows);
  rows.add("robot of kinematics and filter", record.run.filter_robot);
  rows.add("time", fmt::format("{:.3f} s", report.last_t - report.first_t),
           fmt::format("from {:.3f} to {:.3f} s", report.first_t, report.last_t));
  rows.addCount("motor samples", report.motor_samples);
  rows.addCount("camera samples", report.camera_samples, fmt::format("{} pairs of images", report.frames));
  for (const int side : {0, 1}) {
    const auto at = static_cast<std::size_t>(side);
    const char* name = side == 0 ? "left" : "right";
    if (report.blocked[at] > 0)
      rows.addCount(fmt::format("blocked deliberately, {}", name), report.blocked[at], "images");
    rows.addShare(fmt::format("marker detected, {}", name), report.detectionRate(side),
                  fmt::format("{} by the search in the whole frame", report.full_frame[at]));
  }
  for (const auto& [gate, name] : base::NamesOf<Gate>::value)
    if (report.gates[static_cast<std::size_t>(gate)] > 0)
      rows.addShare("gate: " + std::string(name), report.gateShare(gate), "of camera samples");
  addConsistency(report, rows);
  addFaults(report, rows);
  rows.addCount("rescues", report.rescues, "repaired covariances");
  rows.addCount("too late", report.late_dropped, "camera samples older than the filter's memory");
  for (const std::string& notice : record.run.notices) rows.add("notice", notice);
  return table;
}

base::Table eventTable(const SessionRecord& record) {
  base::Table table{record.run.title + ": events", {{"t", "s", 3}, {"kind", {}}, {"text", {}}}, {}, {}};
  std::vector<recording::SessionEvent> events = record.events;  // notes come later than their time
  std::ranges::stable_sort(events, {}, &recording::SessionEvent::t);
  for (const recording::SessionEvent& event : events) table.rows.push_back({event.t, event.kind, event.text});
  return table;
}

}  // namespace

std::vector<SettingsFile> settingsOf(const recording::SessionHeader& header) {
  std::vector<SettingsFile> files;
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) files.push_back({name, text});
  };
  add("robot.yaml", header.robot);
  add("filter.yaml", header.tracking);
  add("marker.yaml", header.marker);
  add("camera_left.yaml", header.camera_left);
  add("camera_right.yaml", header.camera_right);
  if (header.base_from_camera) add("registration.yaml", vision::formatRegistration(*header.base_from_camera));
  add("truth.yaml", header.truth);
  return files;
}

SessionRecord recordOf(const std::filesystem::path& recording, const std::filesystem::path& robot,
                       base::Progress& progress, const std::function<void(const tracking::Snapshot&)>& each) {
  SessionRecord record;
  RunWatch watch;
  robot::Description filter_robot;
  double memory = 0.0;
  watch.begin = [&](const tracking::SourceInfo& info) {
    filter_robot = info.robot;
    memory = tracking::trackingOptionsOf(info).memory;
    recording::SessionHeader header = recording::headerOf(info, {});
    header.tracking = base::writeYaml(tracking::trackingOptionsOf(info));
    record.settings = settingsOf(header);
    for (std::size_t i = 0; i < 3 && i < info.robot.joints.size(); ++i)
      record.joint_names[i] = info.robot.joints[i].name;
  };
  watch.take = [&](const tracking::Snapshot& snapshot) {
    record.report.add(snapshot);
    each(snapshot);
  };
  record.run = trackRun(recording, robot, progress, watch);
  record.health = tracking::healthOf(record.report, filter_robot, memory);
  if (recording.extension() == recording::kSessionSuffix)
    record.events = recording::readSessionEvents(recording);
  return record;
}

std::vector<experiments::NamedTable> tablesOf(const SessionRecord& record) {
  std::vector<experiments::NamedTable> tables;
  tables.push_back({record.run.name + "-report", reportTable(record)});
  if (!record.health.empty())
    tables.push_back({record.run.name + "-health", tracking::healthTable(record.health)});
  if (!record.events.empty()) tables.push_back({record.run.name + "-events", eventTable(record)});
  return tables;
}

}  // namespace capstan::analysis
