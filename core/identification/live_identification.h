#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/convergence.h"
#include "core/identification/live_recording.h"
#include "core/identification/model_error.h"
#include "core/identification/options.h"

namespace capstan::identification {

enum class LiveMethod { kDualUkf, kBatch };

/// Request for one run over the whole recording. LiveIdentification makes it, runLive() executes it.
struct LiveRequest {
  std::uint64_t serial = 0;
  std::shared_ptr<LiveRecording> recording;
  ParameterSet set;
  CameraPoseOptions camera;
  LiveMethod method = LiveMethod::kDualUkf;
  std::vector<double> start;  ///< initial logarithms of the batch method; empty: nominal
};

struct LiveReport {
  std::uint64_t serial = 0;
  LiveMethod method = LiveMethod::kDualUkf;
  std::vector<Estimate>
      estimates;  ///< estimates in the set's order; empty: no camera observation, or cancelled
  std::vector<Convergence> convergence;  ///< convergence in the set's order; dual UKF only
  Trace trace;                           ///< dual UKF only; t from the recording's first sample [s]
  double recorded = 0.0;                 ///< duration of the processed recording [s]
  double seconds = 0.0;                  ///< computing time [s]
  bool cancelled = false;
  std::string fault;                ///< reason for missing estimates, for people
  std::optional<ModelError> error;  ///< of the model on the recording, before and after
};

/// Identifies from the samples that the recording holds now. Made for a thread of its own; cancellable.
LiveReport runLive(const LiveRequest& request, base::Progress& progress);

/// Phase of the live identification. kCollecting: samples arrive and runs follow each other. kStopped: a last
/// run covers the whole recording; the batch method runs on demand. kAccepted: the identified robot is in
/// use.
enum class LivePhase { kIdle, kCollecting, kStopped, kAccepted };

/// Texts of one parameter for the screen.
struct LiveRow {
  std::string name;    ///< r_l1
  std::string value;   ///< "59.02", rounded to the digits of its σ; or "not observable"
  std::string sigma;   ///< "±0.02"
  std::string unit;    ///< mm, kN, N·s/m …
  std::string change;  ///< "−6.5 %", relative to the robot file
  std::string words;   ///< "settled after 41 s", time still needed, or advice
  double share = 0.0;  ///< progress to the goal's σ: 0…1
  bool seen = false, settled = false;

  bool operator==(const LiveRow&) const = default;
};

/// Logic of the identification during a running session, behind the calibration panel; it has no threads and
/// no clocks. Its owner executes the runs that next() requests, one at a time, and gives their reports to
/// take(). take() drops a report that stop(), refine(), discard() or accept() has made obsolete.
///
/// Cost: each run of the dual UKF covers the whole recording and needs about 15 ms per second of it. The next
/// run waits as long as the last one took, so it never needs more than half of one core.
class LiveIdentification {
 public:
  static constexpr double kFirst = 2.0;   ///< duration of the recording before the first run [s]
  static constexpr double kPeriod = 0.5;  ///< shortest time, and shortest new recording, between runs [s]
  static constexpr double kLag =
      2.0;  ///< delay of values behind the recording from which words() reports it [s]

  /// Begins a session. `file` is the robot of the robot file; changes are shown relative to it.
  void begin(const robot::Description& file, std::string title);

  /// Collects samples for `parameters` (see ParameterSet), whose nominal robot is `in_use`. Throws
  /// base::InputError for names that ParameterSet refuses; then nothing changes.
  void start(const robot::Description& in_use, const std::string& parameters,
             const IdentificationOptions& options = {});
  void stop();    ///< kCollecting → kStopped
  void resume();  ///< kStopped → kCollecting: continues the same recording
  void refine();  ///< kCollecting or kStopped → kStopped: requests the batch method over the whole recording
  void cancelRefinement();
  void discard();  ///< → kIdle, or → kAccepted where an accepted robot is in use
  /// → kAccepted. Returns the identified robot, to be used from now on. Call it only if acceptable().
  robot::Description accept();
  /// → kAccepted: `robot`, identified by `origin`, is in use already. Drops the running identification.
  void keep(const robot::Description& robot, std::string origin);
  const std::string& origin() const { return origin_; }  ///< origin of the accepted robot
  /// kAccepted → kIdle. Returns the robot of the robot file, to be used again.
  robot::Description revert();

  LivePhase phase() const { return phase_; }
  /// Recording that takes the samples; null while none are collected.
  std::shared_ptr<LiveRecording> sink() const;
  /// Returns the run to start at `now` [s, any steady clock]; nothing while none is due. It requests each run
  /// once.
  std::optional<LiveRequest> next(double now);
  /// Takes the report of a run. Returns false when it is dropped.
  bool take(LiveReport report, double now);
  /// Notes that a run ended without a report.
  void failed(const std::string& why, double now);

  bool acceptable() const;  ///< true if at least one parameter is observable
  bool refining() const { return refining_; }
  bool refined() const { return shown_.method == LiveMethod::kBatch && !shown_.estimates.empty(); }
  const std::optional<ParameterSet>& set() const { return set_; }
  const LiveReport& shown() const { return shown_; }
  const Trace& trace() const { return trace_; }
  std::vector<LiveRow> rows() const;
  std::string words() const;  ///< state of the identification in one line
  /// Errors of the model on the recording of the shown estimates; after accept(), of the accepted ones.
  const std::optional<ModelError>& error() const {
    return phase_ == LivePhase::kAccepted ? accepted_error_ : shown_.error;
  }
  /// Request for a motion that determines what is weak; nothing where no parameter is.
  std::optional<LiveRequest> motionRequest() const;
  /// Differences between the accepted robot and the robot file.
  std::vector<RobotChange> changes() const;
  /// Parameters that accept() takes: "r_l1 59.02 mm (−6.5 %), k_e2 …".
  std::string summary() const;
  /// Robot file of the accepted robot; comments at its beginning list the changes.
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
  std::vector<double> file_values_;  ///< values of the set's parameters in the robot file
  bool running_ = false, refining_ = false;
  std::uint64_t serial_ = 0, restarts_ = 0;
  double asked_ = 0.0, covered_ = 0.0;  ///< duration of recording in the present and in the last run [s]
  double again_at_ = 0.0;
  LiveReport shown_;
  Trace trace_;
  std::string fault_;
  std::optional<robot::Description> accepted_;
  std::optional<ModelError> accepted_error_;
  std::string origin_;  ///< origin of accepted_
};

}  // namespace capstan::identification
