#include "app/cli/track_output.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "app/cli/console.h"
#include "app/cli/health_output.h"
#include "core/base/error.h"
#include "core/table_files/table_kind.h"
#include "core/tracking/transmission_text.h"

namespace capstan::cli {
namespace {

using tracking::Gate;
using tracking::TrackReport;

std::string percent(double share) { return std::isnan(share) ? "-" : fmt::format("{:.2f} %", 100.0 * share); }

std::string gateText(const TrackReport& report) {
  std::string text;
  for (const auto& [gate, name] : base::NamesOf<Gate>::value)
    if (report.gates[static_cast<std::size_t>(gate)] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, percent(report.gateShare(gate)));
  return text.empty() ? "no camera sample" : text;
}

std::string failedText(const TrackReport& report) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i)
    if (report.motor_failed[i] != tracking::MotorFault::kNone)
      text += fmt::format("motor {}        encoder {} since {:.3f} s: joint {} from the camera alone\n",
                          i + 1, base::nameOf(report.motor_failed[i]), report.motor_failed_since[i], i + 1);
  return text;
}

nlohmann::json failedJson(const TrackReport& report) {
  nlohmann::json failed = nlohmann::json::array();
  for (std::size_t i = 0; i < 3; ++i)
    if (report.motor_failed[i] != tracking::MotorFault::kNone)
      failed.push_back({{"motor", i + 1},
                        {"fault", base::nameOf(report.motor_failed[i])},
                        {"since", report.motor_failed_since[i]}});
  return failed;
}

/// Errors of the transmission that the augmented filter carries, one per line; empty: none.
std::string transmissionText(const tracking::TransmissionEstimate& found) {
  std::string text;
  for (const std::string& line : tracking::linesOf(found))
    text += fmt::format("{:<15}{}\n", text.empty() ? "transmission" : "", line);
  return text;
}

nlohmann::json transmissionJson(const tracking::TransmissionEstimate& found) {
  nlohmann::json joints = nlohmann::json::array();
  for (int i = 0; i < 3; ++i)
    joints.push_back({{"joint", i + 1},
                      {"scale", found.scale(i)},
                      {"scale_sigma", found.scale_sigma(i)},
                      {"scale_probability", found.scale_probability(i)},
                      {"offset", found.offset(i)},
                      {"offset_sigma", found.offset_sigma(i)},
                      {"offset_probability", found.offset_probability(i)},
                      {"compliance", found.compliance(i)},
                      {"compliance_sigma", found.compliance_sigma(i)},
                      {"compliance_probability", found.compliance_probability(i)}});
  return {{"joints", joints},
          {"camera_rotation", toJson(found.camera_rotation)},
          {"camera_shift", toJson(found.camera_shift)},
          {"camera_scale", found.camera_scale},
          {"camera_delay", found.camera_delay},
          {"change_in_question", found.change_in_question},
          {"camera_moved_probability", found.camera_moved_probability}};
}

/// A live session may expect joint encoders that never come.
const char* referenceOf(const TrackReport& report, const tracking::SourceInfo& info) {
  if (report.errors.ukf().count() == 0) return "none";
  return info.own_kinematics ? "own kinematics" : info.reference ? "joint encoders" : "none";
}

}  // namespace

std::optional<NisVerdict> nisVerdict(const TrackReport& report) {
  if (std::isnan(report.nisMean())) return std::nullopt;
  const auto count = static_cast<std::int64_t>(report.gates[static_cast<std::size_t>(Gate::kOpen)]);
  return NisVerdict{report.nisMean(), estimation::chiSquareBand(3, count)};
}

std::string textOf(const TrackReport& report, const tracking::SourceInfo& info, double seconds) {
  std::string text;
  const bool own = info.own_kinematics && report.errors.ukf().count() > 0;
  if (own)
    text += "reference: the robot's own kinematics, no truth; these are differences from it, not errors\n\n";
  text += report.errors.text(own ? "RMS diff." : "RMS error");
  const double span = report.last_t - report.first_t;
  text += fmt::format("\nmotor samples  {} over {:.3f} s\n", report.motor_samples, span);
  text += fmt::format("camera samples {} ({} pairs of images)\n", report.camera_samples, report.frames);
  if (report.frames > 0)
    text += fmt::format("detected       left {}, right {} (full-frame search: {}, {})\n",
                        percent(report.detectionRate(0)), percent(report.detectionRate(1)),
                        report.full_frame[0], report.full_frame[1]);
  if (report.blocked[0] + report.blocked[1] > 0)
    text +=
        fmt::format("blocked        left {}, right {} images, deliberately: not counted in the line above\n",
                    report.blocked[0], report.blocked[1]);
  text += fmt::format("gate           {}\n", gateText(report));
  if (const auto nis = nisVerdict(report)) {
    text += fmt::format("NIS / 3        {:.3f} over accepted camera samples, 95 % band {:.3f} … {:.3f}: {}\n",
                        nis->mean, nis->band.low, nis->band.high, nis->text());
    if (!nis->passed()) text += fmt::format("               {}\n", nis->advice());
  }
  if (report.rays > 0)
    text += fmt::format("one camera     {} samples corrected by the ray of one camera, NIS / 2 {:.3f}\n",
                        report.rays, report.rayNisMean());
  if (!std::isnan(report.neesMean()))
    text += fmt::format("NEES / 3       {:.3f} of positions against the reference\n", report.neesMean());
  text += transmissionText(report.transmission);
  text += failedText(report);
  text += fmt::format("rescues        {}, too late {}\n", report.rescues, report.late_dropped);
  if (seconds > 0.0) text += fmt::format("speed          {:.1f} × real time\n", span / seconds);
  return text;
}

nlohmann::json jsonOf(const TrackReport& report, const tracking::SourceInfo& info) {
  nlohmann::json band, consistent, verdict;
  if (const auto nis = nisVerdict(report)) {
    band = {nis->band.low, nis->band.high};
    consistent = nis->passed();
    verdict = nis->text();
  }
  nlohmann::json gates = nlohmann::json::object();
  for (const auto& [gate, key] : base::KeysOf<Gate>::value)
    gates[std::string(key)] = report.gates[static_cast<std::size_t>(gate)];
  return {{"rms",
           {{"kin", toJson(report.errors.kinematic().value())},
            {"cam", toJson(report.errors.camera().value())},
            {"ukf", toJson(report.errors.ukf().value())}}},
          {"nis", report.nisMean()},
          {"nis_band", band},
          {"nis_consistent", consistent},
          {"nis_verdict", verdict},
          {"nees", report.neesMean()},
          {"rays", report.rays},
          {"ray_nis", report.rayNisMean()},
          {"transmission", transmissionJson(report.transmission)},
          {"reference", referenceOf(report, info)},
          {"samples", report.motor_samples},
          {"camera_samples", report.camera_samples},
          {"frames", report.frames},
          {"references", report.errors.ukf().count()},
          {"blocked", report.blocked},
          {"detected", report.detected},
          {"full_frame", report.full_frame},
          {"gates", gates},
          {"motor_failed", failedJson(report)},
          {"rescues", report.rescues},
          {"late_dropped", report.late_dropped},
          {"first_t", report.first_t},
          {"last_t", report.last_t}};
}

nlohmann::json documentOf(const TrackReport& report, const tracking::SourceInfo& info,
                          const std::vector<tracking::HealthCheck>& health,
                          const std::string& estimator_robot) {
  nlohmann::json document = jsonOf(report, info);
  document["health"] = healthJson(health);
  document["title"] = info.title;
  document["robot"] = {
      {"name", info.robot.name},
      {"file", estimator_robot.empty() ? nlohmann::json() : nlohmann::json(estimator_robot)}};
  return document;
}

namespace {

bool isFifo(const std::string& path) {
  std::error_code fault;
  return std::filesystem::is_fifo(path, fault);
}

recording::RowFormat rowFormatOf(const std::string& target, const std::string& format) {
  const table_files::TableKindFacts* kind = table_files::kindBySuffix(target);
  if (format == "auto" && kind && kind->kind != table_files::TableKind::kCsv &&
      kind->kind != table_files::TableKind::kJsonLines)
    refuseOption("--out", target, fmt::format("is the name of a file for {}", kind->name),
                 "Estimates are CSV or JSON Lines: end it in .csv or .jsonl");
  const bool json =
      format == "jsonl" || (format == "auto" && kind && kind->kind == table_files::TableKind::kJsonLines);
  return json ? recording::RowFormat::kJsonLines : recording::RowFormat::kCsv;
}

}  // namespace

EstimateWriter::EstimateWriter(const std::string& target, Session session, const std::string& format)
    : target_(target) {
  if (target.empty()) return;
  const recording::RowFormat rows = rowFormatOf(target, format);
  const bool live = session == Session::kLive;
  if (live && (live::isAddress(target) || isFifo(target))) {
    rows_.emplace(rows, [this](const std::string& row) { stream_->send(row); });
    stream_ = std::make_unique<live::RowStream>(live::parseAddress(target, "--out"), rows_->header());
    return;
  }
  openFile(session);
  rows_.emplace(rows, [this](const std::string& row) {
    std::fputs(row.c_str(), file_.get());
    if (flush_) std::fflush(file_.get());
  });
  std::fputs(rows_->header().c_str(), file_.get());
}

void EstimateWriter::openFile(Session session) {
  flush_ = session == Session::kLive;
  if (target_ == "-")
    file_.reset(::fdopen(::dup(STDOUT_FILENO), "wb"));
  else if (flush_)
    file_.reset(std::fopen(target_.c_str(), "wb"));
  else
    file_.reset(std::fopen(part_.emplace(target_).path().c_str(), "wb"));
  if (!file_) refuseFile(target_, "cannot be written", "Give another --out");
}

void EstimateWriter::add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
  if (rows_) rows_->add(sample, snapshot);
}

void EstimateWriter::close() {
  if (!rows_) return;
  rows_->flush();
  if (stream_) stream_->close();
  if (!file_) return;
  const bool failed = std::ferror(file_.get()) != 0;
  if (std::fclose(file_.release()) != 0 || failed)
    refuseFile(target_, "could not be written whole", "Is the disk full?");
  if (part_) part_->commit();
}

}  // namespace capstan::cli
