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

/// What the estimator assumes, made from what it may know: the nominal robot.
using RobotBelief = std::function<robot::Description(const robot::Description& nominal)>;

/// The belief of `specification`: its robot file, the parameters that `found` identified, in this order, or
/// nominal. Throws base::InputError where the robot file is unusable.
RobotBelief beliefOf(const Specification& specification, const std::vector<IdentificationResult>& found);

/// `robot` with the parameters that `identification` could see.
robot::Description withIdentified(const robot::Description& robot,
                                  const IdentificationResult& identification);

/// One trial, ready to run: every file of a simulation is read, a recording is looked up.
struct TrialSetup {
  TrialSpec spec;
  std::string recording;                                  ///< path; empty: simulated
  std::optional<simulation::SimulatedOptions> simulated;  ///< of a simulation
  robot::Description table_robot;                         ///< of recordings that bring none
  recording::ReadAs read_as;                              ///< units of a measured table
  RobotBelief belief;
  TrialInputs inputs;          ///< as far as they are known before the recording is opened
  nlohmann::json fingerprint;  ///< everything that the result depends on

  /// How long it takes, for the order of work.
  double weight() const;
};

/// Throws base::InputError for files of the specification that are missing or unusable.
TrialSetup setUpTrial(const Specification& specification, const TrialSpec& trial, const RobotBelief& belief,
                      bool images, const std::string& software);

/// A trial's samples: cameras blocked on schedule, and the robot that the estimator assumes in place of
/// the nominal one. The plant of a simulation stays what it is.
class TrialSource final : public tracking::Source {
 public:
  /// Throws base::InputError for a recording that cannot be read.
  explicit TrialSource(const TrialSetup& setup);

  const tracking::SourceInfo& info() const override { return info_; }
  const robot::Description& nominal() const { return nominal_; }
  bool next(tracking::Sample& out) override { return occluded_->next(out); }
  void block(bool left, bool right) override { occluded_->block(left, right); }
  bool blocked() const { return occluded_->blocked(); }
  /// The trial's inputs, all known now.
  TrialInputs inputs() const { return inputs_; }

 private:
  std::unique_ptr<tracking::Source> source_;
  tracking::SourceInfo info_;
  robot::Description nominal_;
  std::optional<live::OccludedSource> occluded_;
  TrialInputs inputs_;
};

}  // namespace capstan::experiments
