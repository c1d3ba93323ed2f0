#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnosis/residuals/decimated_residual.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/variables.h"
#include "core/stats/interval.h"

namespace capstan::diagnosis {

/// Mean residual over the samples whose variable lies in [low, high).
struct SignatureBin {
  double low = 0.0, high = 0.0;  ///< bounds of the variable
  double centre = 0.0;           ///< mean of the variable in the bin
  double mean = 0.0;             ///< mean of the residual in the bin
  /// 95 % interval of the mean, from the scatter of the time blocks' means, so that it is valid for
  /// correlated samples. NaN if `blocks` is below 2.
  stats::Interval interval;
  std::size_t samples = 0;
  double blocks = 0.0;  ///< effective number of time blocks in the bin, (Σ n_k)² / Σ n_k²
};

/// Signature: how the residual of a channel depends on one variable.
struct Signature {
  VariableKind kind = VariableKind::kTime;
  int joint = 0;  ///< joint of the variable, from 1; 0: of the whole recording
  std::string variable, unit;
  double period = 0.0;             ///< period of the variable; 0: none
  std::string channel;             ///< name of the residual's channel
  std::vector<SignatureBin> bins;  ///< in rising order; empty bins excluded
  /// Share of the residual's variance that the bins' means explain on held-out data:
  ///     1 − Σ (e − p)² / Σ (e − ē)².
  /// The bins' means p and the overall mean ē are estimated on every other segment of time and scored on the
  /// segments between, and vice versa. Each mean is shrunk towards the common mean according to the scatter
  /// of its blocks (random effects, DerSimonian and Laird 1986), and a bin without samples takes the mean of
  /// its neighbours. Noise alone therefore gives a share of about 0, and sometimes a slightly negative one.
  double share = 0.0;
  double share_sigma = 0.0;  ///< standard deviation of `share`, from its scatter between segments
};

/// Signature of `channel` against `variable`, in at most kMostBins bins. Directions have three bins; bins of
/// angles and of time are equally wide; edges of other bins are half way between equal width and equal number
/// of samples. `blocks` is timeBlocks(channel). The segments of Signature::share are as long as a block or as
/// 1/kSegments of the recording, whichever is longer; for the share, time has as many bins as there are pairs
/// of segments. A channel without samples gives no bins and the share 0.
Signature signatureOf(const Channel& channel, const TimeBlocks& blocks, const Variable& variable);
inline constexpr std::size_t kMostBins = 24;
inline constexpr double kSegments = 12.0;

/// Signatures against all variables that concern the channel, in the order of the variables.
std::vector<Signature> signaturesOf(const Channel& channel, const std::vector<Variable>& variables);

}  // namespace capstan::diagnosis
