#include "core/identification/live_identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/identification/better_motion.h"
#include "core/identification/delay_passes.h"
#include "core/identification/estimate_text.h"
#include "core/identification/live_text.h"

namespace capstan::identification {
namespace {

/// Options for runs beside a session: short pieces react quickly to a cancellation, and half of the
/// processors stay free for the session.
ShootingOptions shootingBesideASession() {
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  return {.segment = 20.0, .threads = std::max(1, processors / 2)};
}

void runDual(const IdentificationData& data, const LiveRequest& request, base::Progress& progress,
             LiveReport& report) {
  DualUkfReport found = identifyDualUkfInPasses(data, request.set, {.camera = request.camera}, &progress);
  report.cancelled = found.end == DualUkfEnd::kCancelled;
  if (report.cancelled || found.observations == 0) return;
  report.estimates = std::move(found.estimates);
  report.convergence = std::move(found.convergence);
  report.trace = std::move(found.trace);
  for (TracePoint& point : report.trace) point.t -= data.motors.t.front();
  report.seconds = found.seconds;
}

void runBatch(const IdentificationData& data, const LiveRequest& request, base::Progress& progress,
              LiveReport& report) {
  const BatchOptions options{
      .camera = request.camera, .shooting = shootingBesideASession(), .start = request.start};
  BatchReport found = identifyBatchInPasses(data, request.set, options, &progress);
  report.cancelled = found.end == BatchEnd::kCancelled;
  report.seconds = found.seconds;
  if (found.end == BatchEnd::kFailed)
    report.fault = "The batch method found no solution. The values of the dual UKF stay.";
  else if (!report.cancelled && found.observations > 0)
    report.estimates = std::move(found.estimates);
}

}  // namespace

LiveReport runLive(const LiveRequest& request, base::Progress& progress) {
  LiveReport report;
  report.serial = request.serial;
  report.method = request.method;
  const IdentificationData data = request.recording->data();
  report.recorded = data.duration();
  if (data.openCount() > 0)
    (request.method == LiveMethod::kBatch ? runBatch : runDual)(data, request, progress, report);
  if (!report.estimates.empty()) report.error = modelErrorOf(data, request.set, report.estimates, &progress);
  report.cancelled = report.cancelled || progress.cancelled();
  if (report.estimates.empty() && !report.cancelled && report.fault.empty())
    report.fault = "No camera observation of the tip can be used so far.";
  return report;
}

void LiveIdentification::begin(const robot::Description& file, std::string title) {
  accepted_.reset();
  discard();
  file_ = file;
  title_ = std::move(title);
}

void LiveIdentification::start(const robot::Description& in_use, const std::string& parameters,
                               const IdentificationOptions& options) {
  ParameterSet set(in_use, parameters, options.parameters);
  const ParameterSet of_file(file_, parameters, options.parameters);
  discard();
  file_values_.clear();
  for (const Parameter& parameter : of_file.all()) file_values_.push_back(parameter.nominal);
  set_.emplace(std::move(set));
  options_ = options;
  recording_ = std::make_shared<LiveRecording>(title_);
  phase_ = LivePhase::kCollecting;
}

/// Makes the running request obsolete.
void LiveIdentification::drop() {
  ++serial_;
  running_ = refining_ = false;
}

/// Deletes the results.
void LiveIdentification::forget() {
  shown_ = {};
  trace_.clear();
  fault_.clear();
  covered_ = again_at_ = 0.0;
}

void LiveIdentification::stop() {
  if (phase_ != LivePhase::kCollecting) return;
  drop();
  phase_ = LivePhase::kStopped;
}

void LiveIdentification::resume() {
  if (phase_ != LivePhase::kStopped) return;
  drop();
  phase_ = LivePhase::kCollecting;
}

void LiveIdentification::refine() {
  if (phase_ != LivePhase::kCollecting && phase_ != LivePhase::kStopped) return;
  drop();
  fault_.clear();
  phase_ = LivePhase::kStopped;
  refining_ = true;
}

void LiveIdentification::cancelRefinement() {
  if (refining_) drop();
}

void LiveIdentification::discard() {
  drop();
  forget();
  recording_.reset();
  set_.reset();
  restarts_ = 0;
  phase_ = accepted_ ? LivePhase::kAccepted : LivePhase::kIdle;
}

robot::Description LiveIdentification::accept() {
  drop();
  recording_.reset();
  phase_ = LivePhase::kAccepted;
  accepted_ = identifiedRobot(*set_, shown_.estimates);
  accepted_error_ = shown_.error;
  origin_ = fmt::format("the {} over {:.0f} s of {}", refined() ? "batch method" : "dual UKF",
                        shown_.recorded, title_);
  return *accepted_;
}

void LiveIdentification::keep(const robot::Description& robot, std::string origin) {
  accepted_ = robot;
  accepted_error_.reset();
  origin_ = std::move(origin);
  discard();
}

robot::Description LiveIdentification::revert() {
  accepted_.reset();
  discard();
  return file_;
}

std::shared_ptr<LiveRecording> LiveIdentification::sink() const {
  return phase_ == LivePhase::kCollecting ? recording_ : nullptr;
}

LiveRequest LiveIdentification::request(LiveMethod method) {
  running_ = true;
  LiveRequest request{++serial_, recording_, *set_, options_.camera, method, {}};
  if (method == LiveMethod::kBatch) request.start = logsOf(shown_.estimates);
  return request;
}

std::optional<LiveRequest> LiveIdentification::next(double now) {
  if (running_ || !recording_) return std::nullopt;
  const LiveExtent extent = recording_->extent();
  if (extent.restarts != restarts_) {
    forget();
    restarts_ = extent.restarts;
  }
  if (extent.observations == 0) {
    refining_ = false;
    return std::nullopt;
  }
  const bool all = phase_ == LivePhase::kStopped;
  const bool enough = all ? extent.seconds > covered_
                          : extent.seconds >= std::max(kFirst, covered_ + kPeriod) && now >= again_at_;
  if (!refining_ && !enough) return std::nullopt;
  asked_ = extent.seconds;
  return request(refining_ ? LiveMethod::kBatch : LiveMethod::kDualUkf);
}

bool LiveIdentification::take(LiveReport report, double now) {
  if (!running_ || report.serial != serial_) return false;
  running_ = refining_ = false;
  if (report.cancelled) return false;
  covered_ = std::max(report.recorded, asked_);
  again_at_ = now + std::max(kPeriod, report.seconds);
  fault_ = report.fault;
  if (report.estimates.empty()) return true;
  if (!report.trace.empty()) trace_ = report.trace;
  shown_ = std::move(report);
  return true;
}

void LiveIdentification::failed(const std::string& why, double now) {
  if (!running_) return;
  running_ = refining_ = false;
  covered_ = asked_;
  again_at_ = now + kPeriod;
  fault_ = why;
}

std::optional<LiveRequest> LiveIdentification::motionRequest() const {
  if (!recording_ || !set_ || weakOf(shown_.estimates).empty()) return std::nullopt;
  LiveRequest request{0, recording_, *set_, options_.camera, shown_.method, {}};
  return request;
}

bool LiveIdentification::acceptable() const {
  const bool open = phase_ == LivePhase::kCollecting || phase_ == LivePhase::kStopped;
  return open && std::any_of(shown_.estimates.begin(), shown_.estimates.end(),
                             [](const Estimate& estimate) { return estimate.seen; });
}

double LiveIdentification::changeOf(int i) const {
  const auto at = static_cast<std::size_t>(i);
  return 100.0 * (shown_.estimates[at].value() / file_values_[at] - 1.0);
}

std::vector<LiveRow> LiveIdentification::rows() const {
  std::vector<LiveRow> rows;
  for (int i = 0; set_ && i < set_->size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (shown_.estimates.empty())
      rows.push_back(rowOf((*set_)[i]));
    else
      rows.push_back(rowOf(shown_.estimates[at],
                           shown_.convergence.empty() ? nullptr : &shown_.convergence[at], changeOf(i)));
  }
  return rows;
}

std::string LiveIdentification::words() const {
  if (phase_ == LivePhase::kIdle) return {};
  if (phase_ == LivePhase::kAccepted) return "The identified values are in use, found by " + origin_ + ".";
  if (!fault_.empty()) return fault_;
  const LiveExtent extent = recording_->extent();
  if (refining_) return fmt::format("The batch method runs over all {:.0f} s.", extent.seconds);
  if (shown_.estimates.empty()) return wordsOf(extent);
  const bool collecting = phase_ == LivePhase::kCollecting;
  if (extent.seconds - shown_.recorded > kLag)
    return fmt::format("{} The values below are computed from the first {:.0f} s only. {}", wordsOf(extent),
                       shown_.recorded,
                       collecting ? "The computation is slower than the session; the next one covers all."
                                  : "The computation from all of them is under way.");
  if (collecting) return wordsOf(extent);
  return fmt::format("Stopped. The values are computed from {:.0f} s by the {} {}", shown_.recorded,
                     refined() ? "batch method." : "dual UKF; Refine computes more precise ones.",
                     acceptText(shown_.estimates));
}

std::vector<RobotChange> LiveIdentification::changes() const {
  return accepted_ ? differences(file_, *accepted_) : std::vector<RobotChange>{};
}

std::string LiveIdentification::summary() const {
  std::string text;
  for (const LiveRow& row : rows())
    if (row.seen)
      text +=
          fmt::format("{}{} {} {} ({})", text.empty() ? "" : ", ", row.name, row.value, row.unit, row.change);
  return text;
}

std::string LiveIdentification::robotFile() const {
  if (!accepted_) return {};
  std::string text = fmt::format("# Identified by {}; differs from {} in:\n", origin_, file_.name);
  for (const RobotChange& change : changes())
    text += fmt::format("#   {}: {:.6g} instead of {:.6g} ({:+.2f} %)\n", change.key, change.identified,
                        change.nominal, change.percent);
  return text + robot::formatDescription(*accepted_);
}

}  // namespace capstan::identification
