#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnosis/residuals/decimated_residual.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/variables.h"
#include "core/stats/interval.h"

namespace capstan::diagnosis {

/// The residual where the variable lies in [low, high).
struct SignatureBin {
  double low = 0.0, high = 0.0;  ///< of the variable
  double centre = 0.0;           ///< mean of the variable in the bin
  double mean = 0.0;             ///< of the residual in the bin
  /// 95 % of the mean, from the spread of the time blocks' own means: honest for dependent samples. NaN where
  /// fewer than two blocks' worth of time was spent in the bin.
  stats::Interval interval;
  std::size_t samples = 0;
  double blocks = 0.0;  ///< time blocks that the samples are worth, (Σ n_k)² / Σ n_k²
};

/// How the residual of a channel depends on a variable.
struct Signature {
  VariableKind kind = VariableKind::kTime;
  int joint = 0;  ///< of the variable, from 1; 0: of the whole recording
  std::string variable, unit;
  double period = 0.0;             ///< of the variable; 0: none
  std::string channel;             ///< name of the residual's channel
  std::vector<SignatureBin> bins;  ///< rising; empty ones excluded
  /// Share of the residual's variance that the bins' means explain on data that they were not fitted to:
  ///     1 − Σ (e − p)² / Σ (e − ē)²,
  /// p the bins' means and ē the mean of every other segment of time, scored on those between, both ways
  /// round. Means are drawn towards their common one by what the spread of the blocks makes of them (random
  /// effects, DerSimonian and Laird 1986), and a bin without samples there takes its neighbours', so that
  /// noise alone gives about 0, at times a little less.
  double share = 0.0;
  double share_sigma = 0.0;  ///< standard deviation of `share`, from stretch to stretch
};

struct SignatureOptions {
  std::size_t bins = 24;  ///< at most; directions have three
};

/// The signature of `channel` against `variable`. Bins of angles and of time are equally wide; the others
/// stand half way between equally wide and equally full. `blocks` of timeBlocks(channel). Scored in stretches
/// of a block or a kSegments-th of the recording, whichever is longer; time in as many bins as pairs of
/// these. base::InputError: fewer than two bins requested. A channel without samples gives no bins and share
/// 0.
Signature signatureOf(const Channel& channel, const TimeBlocks& blocks, const Variable& variable,
                      const SignatureOptions& options = {});
inline constexpr double kSegments = 12.0;

/// Of every variable that concerns the channel, in their order.
std::vector<Signature> signaturesOf(const Channel& channel, const std::vector<Variable>& variables,
                                    const SignatureOptions& options = {});

}  // namespace capstan::diagnosis
