#pragma once

#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/residual_process.h"
#include "core/diagnosis/residuals/signature.h"
#include "core/robot/description.h"
#include "core/stats/interval.h"

namespace capstan::diagnosis {

/// Result of a diagnosis in one word.
enum class Verdict {
  kFound,        ///< one cause
  kSeveral,      ///< more than one cause
  kTie,          ///< the recording cannot distinguish two or more causes
  kNothing,      ///< no material effect
  kUnexplained,  ///< a material residual that no hypothesis explains
};

/// Estimated parameter of a cause.
struct FoundParameter {
  std::string name, unit;
  double value = 0.0, sigma = 0.0;  ///< SI
};

/// Reduction of one channel's RMS residual by a cause, on held-out data.
struct Gain {
  std::string channel, unit;
  double rms_before = 0.0, rms_after = 0.0;  ///< without and with the cause
  stats::Interval before, after;             ///< 95 % intervals of these two, by block bootstrap
  stats::Interval interval;                  ///< 95 % interval of rms_after / rms_before, by block bootstrap
};

/// Identified cause: an effect on one joint, with its parameters.
struct Cause {
  std::string effect;
  int joint = 0;  ///< joint, from 1; 0: the whole arm or a camera
  std::vector<FoundParameter> parameters;
  double probability = 0.0;  ///< share of block-bootstrap draws in which it is the best (or needed)
  Gain gain;                 ///< gain of the channel with the largest reduction
};

/// Effects that explain the recording equally well.
struct Tie {
  std::vector<Cause> causes;  ///< best first
  std::string separate;       ///< the motion that would distinguish the causes
};

/// Parameter of the nominal model after the refit.
struct RefitNumber {
  std::string name, unit;  ///< "cable_stiffness of joint 2"
  double nominal = 0.0, value = 0.0, sigma = 0.0;
  bool at_bound = false;  ///< true if the estimate stands at its bound
  bool moved = false;     ///< true if it changed by more than two sigmas
};

/// One hypothesis in the ranking of one round.
struct Candidate {
  std::string effect;
  int joint = 0;
  int round = 1;          ///< round of the forward selection
  double screened = 0.0;  ///< predicted reduction of the residual's mean square (score test), as a share
  bool refitted = false;
  double reduction = 0.0;    ///< largest cross-validated reduction over the channels; NaN: not refitted
  double score = 0.0;        ///< cross-validated log likelihood gain over the model without it [nats]; NaN:
                             ///< not refitted
  double probability = 0.0;  ///< as Cause::probability
};

/// Residuals of one sensor channel of one recording under the three models.
struct ChannelReport {
  int recording = 0;  ///< index of the recording, from 0
  Channel nominal, refitted, extended;
  ChannelStatistics nominal_statistics, refitted_statistics, extended_statistics;
  std::vector<Signature> before, after;  ///< signatures of refitted and of extended, strongest first
  Gain gain;                             ///< gain of extended over refitted, on held-out data
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

/// Stage of a diagnosis, and its duration.
struct Stage {
  std::string name;
  double seconds = 0.0;
};

/// Result of a diagnosis.
struct Report {
  Verdict verdict = Verdict::kNothing;
  std::string summary;  ///< one or two sentences for people
  std::vector<Cause> causes;
  std::vector<Tie> ties;
  std::vector<RefitNumber> refit;
  std::vector<Candidate> candidates;
  std::vector<ChannelReport> channels;
  std::vector<std::string> recordings;     ///< titles of the recordings
  std::vector<ResidualProcess> processes;  ///< of channels whose residual stays unexplained
  std::vector<SpectralLine> lines;
  std::vector<FilterGain> filter;  ///< empty: not requested, or no joint encoders
  double explained = 0.0;          ///< share of the refitted residual beyond noise that the causes explain
  robot::Description refitted, extended;  ///< refitted robot, and the same with all effects
  std::vector<Stage> stages;
  std::vector<std::string> notices;  ///< remarks for the user, one line each
  bool cancelled = false;            ///< true if the diagnosis was cancelled before its end
};

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::Verdict> {
  using V = capstan::diagnosis::Verdict;
  static constexpr std::array value = {std::pair{V::kFound, "found"}, std::pair{V::kSeveral, "several"},
                                       std::pair{V::kTie, "tie"}, std::pair{V::kNothing, "nothing"},
                                       std::pair{V::kUnexplained, "unexplained"}};
};
