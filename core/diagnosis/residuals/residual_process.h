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
  std::size_t points = 600;  ///< largest number of points that the residual is decimated to
  int iterations = 40;       ///< largest number of iterations of each fit
  int shuffles = 4;          ///< number of random orders per variable for its relevance
  std::uint64_t seed = 1;    ///< seed of these orders
};

/// How much the residual depends on one variable.
struct ProcessVariable {
  VariableKind kind = VariableKind::kTime;
  int joint = 0;  ///< joint of the variable, from 1; 0: of the whole recording
  std::string name, unit;
  double length = 0.0;  ///< length scale ℓ, in the variable's unit; long: little dependence
  /// Share of the residual's variance that depends on this variable, on segments of time that were not
  /// fitted:
  ///     (E (e − f(x₋ᵢ, x'ᵢ))² − E (e − f(x))²) / 2 var e,
  /// where x'ᵢ are the variable's values in random order (permutation importance, Breiman 2001; for the true
  /// f it equals Sobol's total index). Noise that f has fitted cancels: without dependence the relevance is
  /// about 0, and can be slightly negative.
  double relevance = 0.0;
  double sigma = 0.0;  ///< standard deviation of `relevance`, from its scatter between segments
};

enum class ProcessEnd { kDone, kTooFew, kCancelled };

/// Gaussian process of a residual that no hypothesis explains. It shows on which variables the residual
/// depends.
struct ResidualProcess {
  ProcessEnd end = ProcessEnd::kTooFew;
  std::string channel;
  std::size_t points = 0;
  double amplitude = 0.0;  ///< standard deviation σ_f of the part that depends on variables [channel unit]
  double noise = 0.0;      ///< standard deviation of white and correlated noise together [channel unit]
  double lasting = 0.0;    ///< standard deviation σ_c of the correlated noise alone [channel unit]
  double memory = 0.0;     ///< time constant τ of the correlated noise [s]
  double explained = 0.0;  ///< share of the variance that is predicted on segments that were not fitted
  std::vector<ProcessVariable> variables;  ///< most relevant first
  /// Result for people: "depends on position of joint 2, strongly; on time, weakly", or on none of them.
  std::string words;
};

/// Gaussian process regression (ard_process.h) of the channel's decimated residual on all variables that
/// concern it. The process is fitted by its marginal likelihood to every other segment (signature.h) and
/// scored on the segments between, and vice versa; a last fit to all segments gives length scales, amplitude
/// and noise. Each fit has two starts, one with equal long length scales and one with short length scales
/// for variables whose signature explains more than 3 %, and continues from the better. The result is kTooFew
/// with fewer than kFewestForProcess samples, without variables, and for a residual that never changes.
ResidualProcess residualProcess(const Channel& channel, const std::vector<Variable>& variables,
                                const ProcessOptions& options = {}, const base::Progress* progress = nullptr);
inline constexpr std::size_t kFewestForProcess = 60;

/// Smallest relevance that is reported as strong, clear and weak. A relevance below two sigmas is not
/// reported, and none is if the process explains less than kWeakly of the held-out variance.
inline constexpr double kStrongly = 0.25, kClearly = 0.08, kWeakly = 0.02;

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::ProcessEnd> {
  using E = capstan::diagnosis::ProcessEnd;
  static constexpr std::array value = {std::pair{E::kDone, "done"}, std::pair{E::kTooFew, "too_few"},
                                       std::pair{E::kCancelled, "cancelled"}};
};
