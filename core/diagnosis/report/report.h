#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/diagnosis/report/tolerance.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/residual_process.h"
#include "core/diagnosis/residuals/signature.h"
#include "core/robot/description.h"
#include "core/stats/interval.h"

namespace capstan::diagnosis {

/// Result of a diagnosis in one word.
enum class Verdict {
  kFound,        ///< one cause
  kSeveral,      ///< more than one cause; any but the first can be one of a tie
  kTie,          ///< the recording cannot distinguish the first cause from competing explanations
  kNothing,      ///< no material effect
  kUnexplained,  ///< a material residual that no hypothesis explains
};

/// Estimated parameter of a cause.
struct FoundParameter {
  std::string name, unit;
  double value = 0.0, sigma = 0.0;  ///< estimate and its standard deviation, SI
  /// For a length of the cable of a revolute joint: rotation of the joint per length, 1 / r_l [rad/m]; else
  /// 0.
  double joint_per_length = 0.0;
  bool at_bound = false;  ///< true if the estimate is at a bound of the fit; σ is then that of other sets
};

/// Reduction of one channel's RMS residual by a cause, on held-out data.
struct Gain {
  std::string channel, unit;
  double rms_before = 0.0, rms_after = 0.0;  ///< without and with the cause
  stats::Interval before, after;             ///< 95 % intervals of these two, by block bootstrap
  stats::Interval interval;                  ///< 95 % interval of rms_after / rms_before, by block bootstrap
};

/// Displacement of a joint or of the tip by an effect: position simulated with the effect minus position
/// simulated without it, over all recordings.
struct Displacement {
  double rms = 0.0, largest = 0.0;  ///< RMS and largest magnitude [m; for revolute joints rad]
  bool slides = false;              ///< true for a prismatic joint and the tip
};

/// Displacement of each joint and of the tip by one effect.
struct Displacements {
  std::vector<Displacement> joints;  ///< [rad or m]; from joint 1
  Displacement tip;                  ///< tip in frame 0, as the cameras measure it [m]
};

/// Identified cause: an effect on one joint, with its parameters.
struct Cause {
  std::string effect;
  int joint = 0;  ///< joint, from 1; 0: the whole arm or a camera
  std::vector<FoundParameter> parameters;
  double probability = 0.0;  ///< posterior probability that the effect belongs to the model
  double loss = 0.0;  ///< held-out log predictive density that is lost without this effect alone [nats]
  Displacements moves = {};  ///< displacement by the effect; joints empty: not computed
  Gain gain = {};            ///< reduction of the channel whose residual falls most
};

/// Effect in a set of the posterior.
struct NamedEffect {
  std::string effect;
  int joint = 0;
};

/// Posterior probability of the model with one set of effects. No effects: the refitted nominal robot.
struct SetProbability {
  std::vector<NamedEffect> effects;
  double probability = 0.0;
};

/// Effects that explain the recording equally well.
struct Tie {
  /// The cause of the model first. Cause::probability is relative: those of one tie add up to 1.
  std::vector<Cause> causes;
  std::string separate;  ///< the motion that would distinguish the causes
};

/// Parameter of the nominal model after the refit.
struct RefitNumber {
  std::string name, unit;  ///< "cable_stiffness of joint 2"
  double nominal = 0.0;
  double value = 0.0, sigma = 0.0;  ///< estimate together with the effects of the model
  bool at_bound = false;            ///< true if the estimate is at its bound
  bool moved = false;               ///< true if `value` differs from `nominal` by more than two sigmas
  double value_without = 0.0;       ///< estimate without any effect
  Displacements moves = {};  ///< displacement by the change alone; joints empty: not moved, not computed
  bool material = false;     ///< true if it moved and `moves` exceeds the tolerance
};

/// One hypothesis in the ranking of one round.
struct Candidate {
  std::string effect;
  int joint = 0;
  int round = 1;          ///< expansion of the search in which it was tested
  double screened = 0.0;  ///< predicted reduction of the residual's mean square (score test), as a share
  bool refitted = false;
  double reduction = 0.0;  ///< largest reduction over the channels by a short refit; NaN: not refitted
  /// Log likelihood of the short refit with the effect minus that without it [nats]; NaN: not refitted.
  double score = 0.0;
  double probability = 0.0;  ///< as Cause::probability; exactly 0: no model fitted until convergence has it
};

/// Residuals of one sensor channel of one recording under the three models.
struct ChannelReport {
  int recording = 0;  ///< index of the recording, from 0
  Channel nominal, refitted, extended;
  ChannelStatistics nominal_statistics, refitted_statistics, extended_statistics;
  std::vector<Signature> before, after;  ///< signatures of `refitted` and of `extended`, strongest first
  Gain gain;                             ///< reduction of RMS from `refitted` to `extended`, on held-out data
};

/// Line in the residual's spectrum that is significantly higher than the spectrum around it.
struct SpectralLine {
  std::string channel;
  double frequency = 0.0;  ///< frequency [Hz]
  double amplitude = 0.0;  ///< amplitude [the channel's unit]
  double p_value = 1.0;    ///< probability that noise has an equally high line at any frequency
};

/// RMS error of one joint's Kalman-filter estimate against its encoder, with each of the three models.
struct FilterGain {
  std::string joint, unit;
  double nominal = 0.0, refitted = 0.0, extended = 0.0;
};

/// How much of a channel's residual regressions on the recorded signals can explain, compared with the
/// effects: RMS residuals on held-out data. Channels of the same sensor in several recordings are one channel
/// here.
struct Explainable {
  std::string channel, unit;
  double noise = 0.0;     ///< RMS noise of the sensor and of the simulation's inputs
  double refitted = 0.0;  ///< RMS residual of the refitted nominal robot
  double named = 0.0;     ///< RMS residual of the model with the effects
  /// RMS residual of a least-squares fit on at most seven measured columns (tip poses: position and velocity
  /// of the reference); NaN: none.
  double linear = 0.0;
  /// RMS residual of a Gaussian process on positions, speeds, loads, torques, directions and time; NaN: none.
  double flexible = 0.0;
  /// (refitted² − named²) / (refitted² − least²), where least is the smaller of linear and flexible; at
  /// most 1. NaN if neither regression explains anything.
  double share = 0.0;
  std::string leans_on;  ///< signals that the regression with the smaller residual depends on
};

/// Proposed recording: the motion that distinguishes the most probable models best (next_experiment.h).
struct NextExperiment {
  std::string motion;                      ///< "joint 2 sweeps slowly, the other joints rest"
  std::vector<NamedEffect> distinguishes;  ///< effects that are in some of these models and not in all
  std::vector<double> t;                   ///< times of the trajectory, from 0 [s]
  Columns q;                               ///< joint positions of the trajectory [rad or m]
  /// Probability of choosing a wrong one of these models: now, and its bound after the recording.
  double confusion_now = 0.0, confusion_after = 0.0;
};

/// Stage of a diagnosis, and its duration.
struct Stage {
  std::string name;
  double seconds = 0.0;
};

/// Result of a diagnosis.
struct Report {
  Verdict verdict = Verdict::kNothing;
  std::string summary;                 ///< one or two sentences for people
  std::vector<Cause> causes;           ///< material effects, the largest Cause::loss first
  std::vector<Cause> also_measurable;  ///< effects below the tolerance or kMaterialShare
  /// Effects of the most probable set that the model lacks, because the set without them is probable enough
  /// (kMinOddsWithout). Their numbers are those of the most probable set; no gain.
  std::vector<Cause> uncertain;
  Tolerance material;
  std::vector<Tie> ties;
  std::vector<SetProbability> posterior;  ///< the most probable set first
  std::vector<RefitNumber> refit;
  std::vector<Candidate> candidates;
  std::vector<ChannelReport> channels;
  std::vector<std::string> recordings;     ///< titles of the recordings
  std::vector<Explainable> explainable;    ///< one per channel; the largest ratio of residual to noise first
  std::vector<ResidualProcess> processes;  ///< processes of channels with an unexplained residual
  std::vector<SpectralLine> lines;
  std::vector<FilterGain> filter;      ///< empty: not requested, or no joint encoders
  std::optional<NextExperiment> next;  ///< only for ties and unexplained residuals of cable drives
  double explained = 0.0;  ///< share of the refitted residual beyond noise that the causes explain
  robot::Description refitted, extended;  ///< refitted robot, and the same with all effects
  std::vector<Stage> stages;
  std::vector<std::string> notices;  ///< remarks for the user, one line each
  bool search_complete = true;       ///< false: the search for causes ended at its limit (kMostWork)
  bool cancelled = false;            ///< true if the diagnosis was cancelled before its end
};
/// Smallest share of a channel's held-out mean square that an effect must remove to be a cause: of two
/// effects that cancel each other, each may move the tip far, and both together hardly move it.
inline constexpr double kMaterialShare = 0.06;

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::Verdict> {
  using V = capstan::diagnosis::Verdict;
  static constexpr std::array value = {std::pair{V::kFound, "found"}, std::pair{V::kSeveral, "several"},
                                       std::pair{V::kTie, "tie"}, std::pair{V::kNothing, "nothing"},
                                       std::pair{V::kUnexplained, "unexplained"}};
};
