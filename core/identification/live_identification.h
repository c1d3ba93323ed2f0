#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/convergence.h"
#include "core/identification/live_recording.h"
#include "core/identification/options.h"

namespace capstan::identification {

enum class LiveMethod { kDualUkf, kBatch };

/// One run over all that a recording holds: what LiveIdentification asks for and runLive() does.
struct LiveRequest {
  std::uint64_t serial = 0;
  std::shared_ptr<LiveRecording> recording;
  ParameterSet set;
  CameraPoseOptions camera;
  LiveMethod method = LiveMethod::kDualUkf;
  std::vector<double> start;  ///< logarithms that the batch method begins with; empty: nominal
};

struct LiveReport {
  std::uint64_t serial = 0;
  LiveMethod method = LiveMethod::kDualUkf;
  std::vector<Estimate> estimates;       ///< in the set's order; empty: no camera observation, or cancelled
  std::vector<Convergence> convergence;  ///< the same; of the dual UKF only
  Trace trace;                           ///< of the dual UKF only; t from the recording's first sample on
  double recorded = 0.0;                 ///< seconds of recording looked at
  double seconds = 0.0;                  ///< of computing
  bool cancelled = false;
  std::string fault;  ///< why there is nothing, in plain words
};

/// Identifies from what the recording holds now. Meant for a thread of its own; cancellable.
LiveReport runLive(const LiveRequest& request, base::Progress& progress);

/// kCollecting: samples come in and runs follow each other. kStopped: a last run over everything; refinement
/// on demand. kAccepted: the identified robot is in use.
enum class LivePhase { kIdle, kCollecting, kStopped, kAccepted };

/// One parameter as a screen shows it.
struct LiveRow {
  std::string name;    ///< r_l1
  std::string value;   ///< "59.02", as many decimals as its σ has meaning; "weak" where it cannot be seen
  std::string sigma;   ///< "±0.02"
  std::string unit;    ///< mm, kN, N·s/m …
  std::string change;  ///< "−6.5 %", from the robot file
  std::string words;   ///< "settled after 41 s", time still needed, or advice
  double share = 0.0;  ///< of the way to the goal's σ: 0…1
  bool seen = false, settled = false;

  bool operator==(const LiveRow&) const = default;
};

/// Identification beside a running session, without threads or clocks: what the calibration panel thinks.
/// Its owner makes the runs that next() asks for, one at a time, and gives the reports to take(); a report
/// that stop(), refine(), discard() or accept() has overtaken is dropped there.
///
/// Cost: the dual UKF needs about 15 ms of computing a second of recording, over the whole recording each
/// time. So the next run waits as long as the last one took, and half of one core is the most it ever needs.
class LiveIdentification {
 public:
  static constexpr double kFirst = 2.0;   ///< recording before the first run [s]
  static constexpr double kPeriod = 0.5;  ///< least time and least new recording between runs [s]
  static constexpr double kLag =
      2.0;  ///< of values behind the recording, from which on words() reports it [s]

  /// A session: `file` is the robot as its file says, against which changes are shown.
  void begin(const robot::Description& file, std::string title);

  /// Collects for `parameters` (see ParameterSet), on top of the robot `in_use`. Throws base::InputError for
  /// a choice that ParameterSet refuses; then nothing changes.
  void start(const robot::Description& in_use, const std::string& parameters,
             const IdentificationOptions& options = {});
  void stop();    ///< kCollecting → kStopped
  void resume();  ///< kStopped → kCollecting: the same recording goes on
  void refine();  ///< kCollecting or kStopped → kStopped: the batch method over everything
  void cancelRefinement();
  void discard();  ///< → kIdle, or kAccepted where an accepted robot is in use
  /// → kAccepted. The robot to be used from now on. Only if acceptable().
  robot::Description accept();
  /// → kAccepted: `robot`, found by `origin`, is in use already. What was under way is given up.
  void keep(const robot::Description& robot, std::string origin);
  const std::string& origin() const { return origin_; }  ///< of the accepted robot
  /// kAccepted → kIdle: the robot file's own values, to be used again.
  robot::Description revert();

  LivePhase phase() const { return phase_; }
  /// Where samples go to; null while nobody collects.
  std::shared_ptr<LiveRecording> sink() const;
  /// The run to be made at `now` [s, any steady clock]; none: not yet. A run that was requested is not
  /// requested again.
  std::optional<LiveRequest> next(double now);
  /// False: dropped.
  bool take(LiveReport report, double now);
  /// A run ended without a report.
  void failed(const std::string& why, double now);

  bool acceptable() const;  ///< something was seen
  bool refining() const { return refining_; }
  bool refined() const { return shown_.method == LiveMethod::kBatch && !shown_.estimates.empty(); }
  const std::optional<ParameterSet>& set() const { return set_; }
  const LiveReport& shown() const { return shown_; }
  const Trace& trace() const { return trace_; }
  std::vector<LiveRow> rows() const;
  std::string words() const;  ///< how things are, one line
  /// Accepted robot against the robot file.
  std::vector<RobotChange> changes() const;
  /// "r_l1 59.02 mm (−6.5 %), k_e2 …": the parameters that accept() takes.
  std::string summary() const;
  /// The accepted robot as a robot file, its changes in comments first.
  std::string robotFile() const;

 private:
  void drop();
  void forget();
  LiveRequest request(LiveMethod method);
  double changeOf(int i) const;

  robot::Description file_;
  std::string title_;
  LivePhase phase_ = LivePhase::kIdle;
  std::shared_ptr<LiveRecording> recording_;
  std::optional<ParameterSet> set_;
  IdentificationOptions options_;
  std::vector<double> file_values_;  ///< of the set's parameters, as the robot file says
  bool running_ = false, refining_ = false;
  std::uint64_t serial_ = 0, restarts_ = 0;
  double asked_ = 0.0, covered_ = 0.0;  ///< recording that the present and the last run look at [s]
  double again_at_ = 0.0;
  LiveReport shown_;
  Trace trace_;
  std::string fault_;
  std::optional<robot::Description> accepted_;
  std::string origin_;  ///< of accepted_
};

}  // namespace capstan::identification
