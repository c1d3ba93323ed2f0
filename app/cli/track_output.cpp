#include "app/cli/track_output.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "app/cli/console.h"
#include "core/base/error.h"
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

void appendCells(std::string& row, const Eigen::Vector3d& values) {
  for (const double value : values)
    row += std::isfinite(value) ? fmt::format(",{:.17g}", value) : std::string(",");
}

constexpr const char* kColumns =
    "t,camera,t_cam,q_kin1,q_kin2,q_kin3,q_cam1,q_cam2,q_cam3,q_ukf1,q_ukf2,q_ukf3,dq_ukf1,dq_ukf2,dq_ukf3,"
    "sigma_ukf1,sigma_ukf2,sigma_ukf3,q1,q2,q3,gate,nis\n";

}  // namespace

const char* referenceOf(const tracking::SourceInfo& info) {
  return info.own_kinematics ? "own kinematics" : info.reference ? "joint encoders" : "none";
}

std::optional<NisVerdict> nisVerdict(const TrackReport& report) {
  if (std::isnan(report.nisMean())) return std::nullopt;
  const auto count = static_cast<std::int64_t>(report.gates[static_cast<std::size_t>(Gate::kOpen)]);
  return NisVerdict{report.nisMean(), estimation::chiSquareBand(3, count)};
}

std::string textOf(const TrackReport& report, const tracking::SourceInfo& info, double seconds) {
  std::string text;
  if (info.own_kinematics)
    text += "reference: the robot's own kinematics, no truth; these are differences from it, not errors\n\n";
  text += report.errors.text();
  const double span = report.last_t - report.first_t;
  text += fmt::format("\nmotor samples  {} over {:.3f} s\n", report.motor_samples, span);
  text += fmt::format("camera samples {} ({} pairs of images)\n", report.camera_samples, report.frames);
  if (report.frames > 0)
    text += fmt::format("detected       left {}, right {} (full-frame search: {}, {})\n",
                        percent(report.detectionRate(0)), percent(report.detectionRate(1)),
                        report.full_frame[0], report.full_frame[1]);
  text += fmt::format("gate           {}\n", gateText(report));
  if (const auto nis = nisVerdict(report)) {
    text += fmt::format("NIS / 3        {:.3f} over accepted camera samples, 95 % band {:.3f} … {:.3f}: {}\n",
                        nis->mean, nis->band.low, nis->band.high, nis->text());
    if (!nis->passed()) text += fmt::format("               {}\n", nis->advice());
  }
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
          {"transmission", transmissionJson(report.transmission)},
          {"reference", referenceOf(info)},
          {"samples", report.motor_samples},
          {"camera_samples", report.camera_samples},
          {"frames", report.frames},
          {"references", report.errors.ukf().count()},
          {"detected", report.detected},
          {"full_frame", report.full_frame},
          {"gates", gates},
          {"motor_failed", failedJson(report)},
          {"rescues", report.rescues},
          {"late_dropped", report.late_dropped},
          {"first_t", report.first_t},
          {"last_t", report.last_t}};
}

EstimateWriter::EstimateWriter(const std::filesystem::path& path) : path_(path) {
  if (path.empty()) return;
  part_.emplace(path);
  file_.reset(std::fopen(part_->path().c_str(), "wb"));
  if (!file_) refuseFile(path.string(), "cannot be written", "Give another --out");
  std::fputs(kColumns, file_.get());
}

void EstimateWriter::add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
  if (!file_) return;
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::nan(""));
  if (std::holds_alternative<tracking::MotorSample>(sample)) {
    flush();
    motor_row_ = snapshot;
    reference_ = snapshot.reference_paired ? snapshot.q_link_true : none;
  } else if (std::holds_alternative<tracking::JointSample>(sample)) {
    if (snapshot.reference_paired) reference_ = snapshot.q_link_true;
  } else {
    flush();
    write(snapshot, snapshot.q_link_true_cam);
  }
}

void EstimateWriter::flush() {
  if (motor_row_) write(*motor_row_, reference_);
  motor_row_.reset();
}

void EstimateWriter::write(const tracking::Snapshot& s, const Eigen::Vector3d& reference) {
  std::string row = fmt::format("{:.17g},{}", s.t, s.camera_updated ? 1 : 0);
  row += s.camera_updated ? fmt::format(",{:.17g}", s.t_cam) : std::string(",");
  appendCells(row, s.q_link_kin);
  appendCells(row,
              s.camera_updated ? s.q_link_cam : Eigen::Vector3d(Eigen::Vector3d::Constant(std::nan(""))));
  appendCells(row, s.q_link_ukf);
  appendCells(row, s.dq_link_ukf);
  appendCells(row, s.q_link_ukf_sigma);
  appendCells(row, reference);
  row += fmt::format(",{},", base::nameOf(s.gate));
  if (s.camera_updated && std::isfinite(s.nis)) row += fmt::format("{:.17g}", s.nis);
  row += '\n';
  std::fputs(row.c_str(), file_.get());
}

void EstimateWriter::close() {
  if (!file_) return;
  flush();
  const bool failed = std::ferror(file_.get()) != 0;
  if (std::fclose(file_.release()) != 0 || failed)
    refuseFile(path_.string(), "could not be written whole", "Is the disk full?");
  part_->commit();
}

}  // namespace capstan::cli
