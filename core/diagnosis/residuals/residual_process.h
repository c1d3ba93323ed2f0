#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/variables.h"

namespace capstan::diagnosis {

struct ProcessOptions {
  std::size_t points = 600;  ///< of the residual, decimated; at most
  int iterations = 40;       ///< of each fit
  int shuffles = 4;          ///< a variable's values are shuffled so often
  std::uint64_t seed = 1;    ///< of the shuffles
};

/// How much the residual depends on one variable.
struct ProcessVariable {
  VariableKind kind = VariableKind::kTime;
  int joint = 0;  ///< from 1; 0: of the whole recording
  std::string name, unit;
  double length = 0.0;  ///< over which the residual changes, in the variable's unit; long: hardly at all
  /// Variance of the prediction when this variable alone moves, as a share of the residual's variance, on
  /// segments of time that were not fitted:
  ///     (E (e − f(x₋ᵢ, x'ᵢ))² − E (e − f(x))²) / 2 var e,   x'ᵢ the variable's values in another order
  /// (permutation importance, Breiman 2001; of a right f it is Sobol's total index). What f learnt of noise
  /// cancels: about 0, at times a little less, where there is no dependence.
  double relevance = 0.0;
  double sigma = 0.0;  ///< standard deviation of `relevance`, from stretch to stretch
};

enum class ProcessEnd { kDone, kTooFew, kCancelled };

/// What a Gaussian process says of a residual that no hypothesis explains.
struct ResidualProcess {
  ProcessEnd end = ProcessEnd::kTooFew;
  std::string channel;
  std::size_t points = 0;
  double amplitude = 0.0;  ///< standard deviation of what depends on the variables [the channel's unit]
  double noise = 0.0;      ///< and of what does not, white or lasting [the channel's unit]
  double lasting = 0.0;    ///< of this, what lasts a while, whatever the variables do [the channel's unit]
  double memory = 0.0;     ///< for how long, to a 1/e-th [s]
  double explained = 0.0;  ///< share of the variance predicted on segments that were not fitted
  std::vector<ProcessVariable> variables;  ///< most relevant first
  /// "depends on position of joint 2, strongly; on time, weakly", or that it depends on none of them.
  std::string words;
};

/// Gaussian process regression (ard_process.h) of the channel's residual, decimated, on all variables that
/// concern it. Fitted by its marginal likelihood to every other stretch (signature.h) and judged on those
/// between, both ways round; lengths, amplitude and noise by a last fit to all. Each fit starts twice, from
/// long lengths all alike and from short ones where the signature shows something, and goes on with the
/// better. kTooFew: fewer than kFewestForProcess samples, no variable, or a residual that never changes.
ResidualProcess residualProcess(const Channel& channel, const std::vector<Variable>& variables,
                                const ProcessOptions& options = {}, base::Progress* progress = nullptr);
inline constexpr std::size_t kFewestForProcess = 60;

/// Relevance from which on it is said: strongly, clearly, weakly; and only beyond two sigmas, of a process
/// that explains at least the least of these on segments that were not fitted.
inline constexpr double kStrongly = 0.25, kClearly = 0.08, kWeakly = 0.02;

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::ProcessEnd> {
  using E = capstan::diagnosis::ProcessEnd;
  static constexpr std::array value = {std::pair{E::kDone, "done"}, std::pair{E::kTooFew, "too_few"},
                                       std::pair{E::kCancelled, "cancelled"}};
};
