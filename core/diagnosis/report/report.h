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

enum class Verdict {
  kFound,        ///< one effect
  kSeveral,      ///< more than one
  kTie,          ///< the recording cannot distinguish two or more
  kNothing,      ///< nothing material
  kUnexplained,  ///< something is there that no hypothesis explains
};

struct FoundParameter {
  std::string name, unit;
  double value = 0.0, sigma = 0.0;  ///< SI
};

/// What knowing a cause is worth on one channel, on data that were not fitted.
struct Gain {
  std::string channel, unit;
  double rms_before = 0.0, rms_after = 0.0;
  stats::Interval before, after;  ///< 95 % of each, block bootstrap
  stats::Interval interval;       ///< 95 % of rms_after / rms_before, block bootstrap
};

struct Cause {
  std::string effect;
  int joint = 0;  ///< from 1; 0: the whole arm or a camera
  std::vector<FoundParameter> parameters;
  double probability = 0.0;  ///< share of block-bootstrap draws in which it is the best (or needed)
  Gain gain;                 ///< on the channel that gains most
};

/// Effects that explain the recording equally well.
struct Tie {
  std::vector<Cause> causes;  ///< best first
  std::string separate;       ///< the motion that would distinguish them
};

/// A number of the nominal model after the refit.
struct RefitNumber {
  std::string name, unit;  ///< "cable_stiffness of joint 2"
  double nominal = 0.0, value = 0.0, sigma = 0.0;
  bool at_bound = false;  ///< it would go further than a mistuned number may
  bool moved = false;     ///< by more than two sigmas
};

/// One hypothesis in the ranking of one round.
struct Candidate {
  std::string effect;
  int joint = 0;
  int round = 1;          ///< of the forward selection
  double screened = 0.0;  ///< share of the residual's mean square that the score test expects the effect to remove
  bool refitted = false;
  double reduction = 0.0;  ///< cross-validated, of the channel that gains most; NaN: not refitted
  double score = 0.0;      ///< cross-validated, above the model without it [nats]; NaN: not refitted
  double probability = 0.0;
};

/// A sensor channel of one recording through the three models.
struct ChannelReport {
  int recording = 0;  ///< from 0
  Channel nominal, refitted, extended;
  ChannelStatistics nominal_statistics, refitted_statistics, extended_statistics;
  std::vector<Signature> before, after;  ///< of refitted and of extended, the strongest first
  Gain gain;                             ///< of extended over refitted, held out
};

/// A line in the spectrum of the residual that stands out of what is around it.
struct SpectralLine {
  std::string channel;
  double frequency = 0.0;  ///< [Hz]
  double amplitude = 0.0;  ///< [the channel's unit]
  double p_value = 1.0;    ///< of as high a line in noise, all frequencies counted
};

/// What the Kalman filter gains: RMS of its joint errors against the encoders.
struct FilterGain {
  std::string joint, unit;
  double nominal = 0.0, refitted = 0.0, extended = 0.0;
};

/// How long each stage took [s].
struct Stage {
  std::string name;
  double seconds = 0.0;
};

struct Report {
  Verdict verdict = Verdict::kNothing;
  std::string summary;  ///< one or two sentences for people
  std::vector<Cause> causes;
  std::vector<Tie> ties;
  std::vector<RefitNumber> refit;
  std::vector<Candidate> candidates;
  std::vector<ChannelReport> channels;
  std::vector<std::string> recordings;     ///< titles
  std::vector<ResidualProcess> processes;  ///< where something stays unexplained
  std::vector<SpectralLine> lines;
  std::vector<FilterGain> filter;  ///< empty: not requested, or no joint encoders
  double explained =
      0.0;  ///< share of what is beyond noise in the refitted residual that the causes take off
  robot::Description refitted, extended;  ///< robot files
  std::vector<Stage> stages;
  std::vector<std::string> notices;
  bool cancelled = false;
};

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::Verdict> {
  using V = capstan::diagnosis::Verdict;
  static constexpr std::array value = {std::pair{V::kFound, "found"}, std::pair{V::kSeveral, "several"},
                                       std::pair{V::kTie, "tie"}, std::pair{V::kNothing, "nothing"},
                                       std::pair{V::kUnexplained, "unexplained"}};
};
