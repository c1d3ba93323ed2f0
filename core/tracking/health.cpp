#include "core/tracking/health.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/tracking/transmission_text.h"

namespace capstan::tracking {
namespace {

using Checks = std::vector<HealthCheck>;

constexpr std::string_view kNisKey = "nis_q";  ///< of a joint's check, before the joint's number

/// Verdict on a number that is good while it is small; kUnknown for NaN.
HealthVerdict judge(double value, double pass, double fail) {
  if (std::isnan(value)) return HealthVerdict::kUnknown;
  if (value <= pass) return HealthVerdict::kPass;
  return value <= fail ? HealthVerdict::kCautious : HealthVerdict::kFail;
}

/// Adds a check; the advice stays away where it passes.
void add(Checks& checks, HealthCheck check) {
  if (check.verdict == HealthVerdict::kPass || check.verdict == HealthVerdict::kUnknown) check.advice.clear();
  checks.push_back(std::move(check));
}

double share(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// Mean NIS per joint of the newest camera updates, `updates` or somewhat more; NaN without any.
Eigen::Vector3d recentNis(const InnovationRecord& record, std::uint64_t updates) {
  InnovationRecord::Window sum;
  for (std::size_t k = record.windows().size(); k-- > 0 && sum.count < updates;) {
    sum.count += record.windows()[k].count;
    sum.squares += record.windows()[k].squares;
  }
  return sum.nis();
}

void addNis(const TrackReport& report, const robot::Description& robot, const HealthLimits& limits,
            Checks& checks) {
  const Eigen::Vector3d nis = report.innovations.nis();
  const Eigen::Vector3d recent = recentNis(report.innovations, limits.recent_updates);
  const std::uint64_t count = report.innovations.count();
  const bool judged = count >= limits.updates;
  for (int joint = 0; joint < 3; ++joint) {
    // Cameras that are moved after an hour show in the newest updates long before they show in the mean.
    const bool failing = judged && nis(joint) <= limits.nis_fail && recent(joint) > limits.nis_fail;
    const double mean = failing ? recent(joint) : nis(joint);
    const std::string name = robot.joints[static_cast<std::size_t>(joint)].name;
    HealthCheck check{fmt::format("{}{}", kNisKey, joint + 1), fmt::format("NIS of {}", name)};
    if (judged) check.verdict = judge(mean, limits.nis, limits.nis_fail);
    if (check.verdict == HealthVerdict::kPass && mean < limits.nis_low)
      check.verdict = HealthVerdict::kCautious;
    if (count > 0) check.value = fmt::format("{:.2f}", mean);
    if (count > 0 && !judged)
      check.value += fmt::format("; {} of the {} camera updates needed", count, limits.updates);
    if (failing) check.value += fmt::format(" in the newest camera updates; {:.2f} in all", nis(joint));
    check.expected = fmt::format("{:.2g} to {:.2g}; 1 where σ is right", limits.nis_low, limits.nis);
    check.advice =
        mean > 1.0
            ? fmt::format(
                  "Camera and filter disagree by {:.1f} times the predicted σ. Restore an earlier "
                  "registration or register the cameras again; if NIS stays high, identify the robot, or "
                  "raise position_noise.",
                  std::sqrt(mean))
            : fmt::format(
                  "Camera and filter disagree by only {:.2f} of the predicted σ: the stated σ is "
                  "larger than the error. Nothing is wrong. Lower registration_rotation_sigma, "
                  "camera_sigma_floor or tip_sigma only to values that were measured.",
                  std::sqrt(mean));
    add(checks, std::move(check));
  }
}

void addNees(const TrackReport& report, const HealthLimits& limits, Checks& checks) {
  if (report.nees_count == 0) return;
  const double nees = report.neesMean();
  add(checks, {"nees", "NEES / 3", judge(nees, limits.nees, limits.nees_fail), fmt::format("{:.2f}", nees),
               fmt::format("at most {:.2g}", limits.nees),
               fmt::format("The estimate is off by {:.1f} times the σ that the filter states. Identify the "
                           "robot, or register the cameras again.",
                           std::sqrt(nees))});
}

/// Number of camera samples that corrected the estimate.
std::uint64_t usedOf(const TrackReport& report) {
  return report.gates[static_cast<std::size_t>(Gate::kOpen)] + report.rays;
}

void addTransmission(const TrackReport& report, Checks& checks) {
  const std::vector<std::string> lines = linesOf(report.transmission);
  HealthCheck check{"transmission", "transmission and cameras"};
  if (report.transmission.change_in_question)
    check.verdict = HealthVerdict::kFail;
  else if (!lines.empty())
    check.verdict = HealthVerdict::kCautious;
  else if (usedOf(report) > 0)
    check.verdict = HealthVerdict::kPass;
  check.value = !lines.empty()       ? fmt::format("{}", fmt::join(lines, "; "))
                : usedOf(report) > 0 ? "no error found"
                                     : "not observed";
  check.expected = "no error found";
  const DelayField field = report.live_cameras ? DelayField::kLiveSetup : DelayField::kOptions;
  check.advice = fmt::format("{}", fmt::join(remediesOf(report.transmission, field), " "));
  add(checks, std::move(check));
}

/// How the cameras take part in the estimate.
enum class Images {
  kUsed,
  kNoCameras,     ///< a robot or recording without cameras
  kNoneCame,      ///< live cameras that sent no pair
  kUnregistered,  ///< no pair is used before a registration
  kExcluded,      ///< every pair was excluded for other reasons
};

Images imagesOf(const TrackReport& report) {
  if (usedOf(report) > 0) return Images::kUsed;
  if (report.camera_samples == 0) return report.live_cameras ? Images::kNoneCame : Images::kNoCameras;
  const bool unregistered =
      report.gates[static_cast<std::size_t>(Gate::kUnregistered)] > 0;  // the rest: no marker
  return unregistered ? Images::kUnregistered : Images::kExcluded;
}

std::string adviceOf(Images images, bool live) {
  const std::string alone = "The estimate is by the motors alone. ";
  switch (images) {
    case Images::kUsed:
      return {};
    case Images::kNoCameras:
      return alone + "No camera observes the joints: errors of cables and pulleys remain unknown.";
    case Images::kNoneCame:
      return alone +
             "No pair of images came. Check addresses, stamps, pairing and latency of the cameras in the "
             "live set-up.";
    case Images::kUnregistered:
      return alone + "The cameras are not registered. Register them" +
             (live ? ", and name the file in the live set-up (cameras.registration)." : ".");
    default:
      return alone +
             "Every pair was excluded. Look at the gate's reasons, the detection of the marker and the "
             "latency.";
  }
}

/// The other checks of images judge only what came. Silent in a recording whose images are used.
void addCameras(const TrackReport& report, const HealthLimits& limits, Checks& checks) {
  const Images images = imagesOf(report);
  const bool used = images == Images::kUsed, none = images == Images::kNoCameras;
  if (used && !report.live_cameras) return;
  HealthCheck check{"cameras", "cameras", HealthVerdict::kPass};
  if (!used) check.verdict = none ? HealthVerdict::kCautious : HealthVerdict::kFail;
  if (!used && report.last_t - report.first_t < limits.no_images) check.verdict = HealthVerdict::kUnknown;
  check.value = used   ? fmt::format("{} of {} samples used", usedOf(report), report.camera_samples)
                : none ? "none"
                       : "no image was used";
  check.expected = "images are used";
  check.advice = adviceOf(images, report.live_cameras);
  add(checks, std::move(check));
}

std::string detectionText(const TrackReport& report, int side) {
  const std::uint64_t blocked = report.blocked[static_cast<std::size_t>(side)];
  if (report.unblocked(side) == 0) return fmt::format("all {} images were blocked deliberately", blocked);
  const double rate = 100.0 * report.detectionRate(side);
  if (blocked == 0) return fmt::format("{:.1f} % of images", rate);
  return fmt::format("{:.1f} % of {} images; {} more were blocked deliberately", rate, report.unblocked(side),
                     blocked);
}

/// Images whose view was blocked deliberately are no evidence of a fault.
std::string missedAdvice(const TrackReport& report, int side, const std::string& name) {
  if (report.wrong_image[static_cast<std::size_t>(side)] > report.frames / 2)
    return fmt::format(
        "The images of the {} camera have another size or format than its calibration. Calibrate at this "
        "size, "
        "let the camera send the calibrated one, or correct the layout in the live set-up.",
        name);
  return fmt::format(
      "The marker was not found in {:.0f} % of the {} camera's images. Remove what hides it, or set the "
      "marker's colour and the exposure again.",
      100.0 * (1.0 - report.detectionRate(side)), name);
}

void addDetection(const TrackReport& report, const HealthLimits& limits, Checks& checks) {
  if (report.frames == 0) return;
  for (const int side : {0, 1}) {
    const std::string name = side == 0 ? "left" : "right";
    const double rate = report.detectionRate(side);
    add(checks, {"detection_" + name, fmt::format("marker in the {} image", name),
                 judge(1.0 - rate, limits.undetected, limits.undetected_fail), detectionText(report, side),
                 fmt::format("at least {:.0f} %", 100.0 * (1.0 - limits.undetected)),
                 missedAdvice(report, side, name)});
  }
}

void addRefused(const TrackReport& report, const HealthLimits& limits, Checks& checks) {
  const std::uint64_t refused = report.gates[static_cast<std::size_t>(Gate::kJump)] +
                                report.gates[static_cast<std::size_t>(Gate::kUnreachable)] +
                                report.gates[static_cast<std::size_t>(Gate::kExchanged)];
  if (refused + usedOf(report) == 0) return;
  const double part = share(refused, report.camera_samples);
  add(checks,
      {"refused", "refused camera samples", judge(part, limits.refused, limits.refused_fail),
       fmt::format("{:.2f} % ({})", 100.0 * part, refused),
       fmt::format("at most {:.0f} %", 100.0 * limits.refused),
       report.gates[static_cast<std::size_t>(Gate::kExchanged)] > refused / 2
           ? "Left and right camera are exchanged: exchange their plugs, or left and right in the "
             "live set-up."
           : "The gate refuses tips that jump or that the arm cannot reach. Look for other objects of "
             "the marker's colour, and at jump_tolerance."});
}

/// `late`: 99 % quantile. Infinity: longer than what is measured.
std::string latencyText(double median, double late) {
  const std::string above = fmt::format("above {:.0f} s", LatencyCounts::kLongest);
  if (std::isinf(median)) return "median " + above;
  return fmt::format("median {:.0f} ms, ", 1e3 * median) +
         (std::isinf(late) ? "more than 1 % " + above : fmt::format("99 % within {:.0f} ms", 1e3 * late));
}

void addLatency(const TrackReport& report, double memory, const HealthLimits& limits, Checks& checks) {
  if (report.latencies.count() == 0) return;
  const double late = report.latencies.quantile(0.99), median = report.latencies.quantile(0.5);
  HealthCheck check{"latency", "camera latency"};
  check.verdict = judge(late / memory, limits.latency, limits.latency_fail);
  if (report.late_dropped > 0) check.verdict = std::max(check.verdict, HealthVerdict::kCautious);
  check.value = latencyText(median, late);
  if (report.late_dropped > 0) check.value += fmt::format(", {} too late", report.late_dropped);
  check.expected = fmt::format("within {:.0f} ms", 1e3 * limits.latency * memory);
  check.advice = fmt::format(
      "The filter remembers {:.0f} ms; later camera samples are lost. Raise memory, "
      "or lower the cameras' resolution.",
      1e3 * memory);
  add(checks, std::move(check));
}

void addRescues(const TrackReport& report, const HealthLimits& limits, Checks& checks) {
  const double part = share(report.rescues, report.motor_samples);
  add(checks, {"rescues", "repaired covariances", judge(part, limits.rescues, limits.rescues_fail),
               fmt::format("{}", report.rescues), "none",
               "The covariance lost definiteness and was repaired. Check the robot file's constants and the "
               "noise options for extreme values."});
}

void addEncoders(const TrackReport& report, Checks& checks) {
  std::vector<std::string> failed;
  for (std::size_t i = 0; i < 3; ++i)
    if (report.motor_failed[i] != MotorFault::kNone)
      failed.push_back(fmt::format("motor {}: {} since {:.1f} s", i + 1, base::nameOf(report.motor_failed[i]),
                                   report.motor_failed_since[i]));
  add(checks, {"encoders", "motor encoders", failed.empty() ? HealthVerdict::kPass : HealthVerdict::kFail,
               failed.empty() ? "all in use" : fmt::format("{}", fmt::join(failed, "; ")), "all in use",
               "The joint is estimated from the camera alone until the motor is declared in use again. Check "
               "the encoder and its cable."});
}

void addLost(const TrackReport& report, const HealthLimits& limits, Checks& checks) {
  const std::uint64_t lost = report.lost + report.motor_refused + report.motor_stray;
  const double part = share(lost, report.motor_samples + report.camera_samples);
  HealthCheck check{
      "lost",
      "lost samples",
      judge(part, limits.lost, limits.lost_fail),
      fmt::format("{}", lost),
      "none",
      "Samples were missing, dropped, not later than the one before, or stray: with motor positions that no "
      "arm can have reached since then. Check the connection, the device's clock and the load of this "
      "computer."};
  if (report.motor_refused > 0) check.value += fmt::format(" ({} refused)", report.motor_refused);
  if (report.motor_stray > 0) check.value += fmt::format(" ({} stray)", report.motor_stray);
  add(checks, std::move(check));
}

void addRefusals(const TrackReport& report, Checks& checks) {
  if (report.refusal.empty()) return;
  add(checks, {"refusals", "refused data", HealthVerdict::kCautious, "yes", "none",
               "Data were refused: " + report.refusal});
}

}  // namespace

std::uint64_t lostOf(const std::vector<SideStatus>& sides) {
  std::uint64_t lost = 0;
  for (const SideStatus& side : sides) lost += side.missing + side.dropped;
  return lost;
}

void noteSource(const SourceInfo& info, const std::vector<SideStatus>& sides, TrackReport& report) {
  report.lost = lostOf(sides);
  for (const SideStatus& side : sides)
    if (side.refused > 0) report.refusal = side.fault;
  report.live_cameras = info.real_time && info.rig.has_value();
}

std::vector<HealthCheck> healthOf(const TrackReport& report, const robot::Description& robot, double memory,
                                  const HealthLimits& limits) {
  Checks checks;
  if (report.motor_samples == 0) return checks;
  addNis(report, robot, limits, checks);
  addNees(report, limits, checks);
  addTransmission(report, checks);
  addCameras(report, limits, checks);
  addDetection(report, limits, checks);
  addRefused(report, limits, checks);
  addLatency(report, memory, limits, checks);
  addRescues(report, limits, checks);
  addEncoders(report, checks);
  addLost(report, limits, checks);
  addRefusals(report, checks);
  return checks;
}

std::vector<HealthCheck> nisChecksOf(const std::vector<HealthCheck>& checks) {
  std::vector<HealthCheck> found;
  for (const HealthCheck& check : checks)
    if (check.key.starts_with(kNisKey)) found.push_back(check);
  return found;
}

HealthVerdict worstOf(const std::vector<HealthCheck>& checks) {
  HealthVerdict worst = HealthVerdict::kUnknown;
  for (const HealthCheck& check : checks) worst = std::max(worst, check.verdict);
  return worst;
}

base::Table healthTable(const std::vector<HealthCheck>& checks) {
  base::Table table{"Estimator health",
                    {{"check", {}}, {"verdict", {}}, {"value", {}}, {"expected", {}}, {"advice", {}}},
                    {},
                    {}};
  for (const HealthCheck& check : checks)
    table.rows.push_back(
        {check.name, std::string(base::nameOf(check.verdict)), check.value, check.expected, check.advice});
  return table;
}

}  // namespace capstan::tracking
