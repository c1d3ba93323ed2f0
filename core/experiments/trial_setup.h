#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/experiments/results.h"
#include "core/experiments/specification.h"
#include "core/live/occluded_source.h"
#include "core/recording/column_units.h"
#include "core/robot/description.h"
#include "core/simulation/simulated_source.h"
#include "core/tracking/source.h"

namespace capstan::experiments {

/// Function that gives the robot that the estimator assumes, from the nominal robot.
using RobotBelief = std::function<robot::Description(const robot::Description& nominal)>;

/// Robot assumed by `specification`: its robot file, or the nominal robot with the parameters of `found`
/// applied in order. Throws base::InputError where the robot file is unusable.
RobotBelief beliefOf(const Specification& specification, const std::vector<IdentificationResult>& found);

/// `robot` with the estimates of the parameters that are observable in `identification`.
robot::Description withIdentified(const robot::Description& robot,
                                  const IdentificationResult& identification);

/// Setup of one trial. All files of a simulation are read; a recording is found but not yet opened.
struct TrialSetup {
  TrialSpec spec;
  std::string recording;                                  ///< path of the recording; empty: simulated
  std::optional<simulation::SimulatedOptions> simulated;  ///< options of a simulation
  robot::Description table_robot;                         ///< robot of recordings that contain none
  recording::ReadAs read_as;                              ///< units of a measured table
  RobotBelief belief;
  TrialInputs inputs;  ///< inputs that are known before the recording is opened
  /// All inputs that the result depends on; of a recording its checksum, once it was added.
  nlohmann::json fingerprint;

  /// Relative computing time, for the order of work.
  double weight() const;
  /// Adds the checksum of the recording, if there is one, to the fingerprint. Reads the whole file. Throws
  /// base::InputError when it cannot be read.
  void addChecksum();
};

/// Sets up a trial. Throws base::InputError for missing or unusable files of the specification.
TrialSetup setUpTrial(const Specification& specification, const TrialSpec& trial, const RobotBelief& belief,
                      bool images, const std::string& software);

/// Samples of a trial. The cameras are blocked on schedule, and the robot in info() is the one that the
/// estimator assumes. The plant of a simulation does not change.
class TrialSource final : public tracking::Source {
 public:
  /// Throws base::InputError for a recording that cannot be read.
  explicit TrialSource(const TrialSetup& setup);

  const tracking::SourceInfo& info() const override { return info_; }
  const robot::Description& nominal() const { return nominal_; }
  bool next(tracking::Sample& out) override { return occluded_->next(out); }
  void block(bool left, bool right) override { occluded_->block(left, right); }
  bool blocked() const { return occluded_->blocked(); }
  /// All inputs of the trial.
  TrialInputs inputs() const { return inputs_; }

 private:
  std::unique_ptr<tracking::Source> source_;
  tracking::SourceInfo info_;
  robot::Description nominal_;
  std::optional<live::OccludedSource> occluded_;
  TrialInputs inputs_;
};

}  // namespace capstan::experiments
