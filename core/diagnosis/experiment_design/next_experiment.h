#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/selection/selection.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// Motion that distinguishes the most probable sets of effects best. Each motion of testMotions() is
/// simulated with the fit of each set. The difference d between the readings that two sets predict counts by
/// its Mahalanobis distance
///     D = dᵀ (R + J C Jᵀ)⁻¹ d,
/// with the covariance C of the fitted parameters, their derivatives J, and the noise R: the residual of the
/// selected set, with its correlation in time. The probability of choosing a wrong set is at most
///     Σ_{i<j} √(p_i p_j) exp(−D_ij / 8)
/// (Bhattacharyya bound for equal covariances; Fukunaga 1990, section 3.4), and the motion with the smallest
/// bound is chosen. Effects that happen once (an encoder that slipped) are excluded from the simulation,
/// because a new recording does not repeat them.
///
/// Only for cable drives; empty for rigid drives, for fewer than two sets, and if `progress` is cancelled.
/// `zeros`: whether the encoder zeros of a new recording are known.
std::optional<NextExperiment> nextExperiment(const FitData& data, const std::vector<Evidence>& recordings,
                                             const Selection& selection, const robot::Description& nominal,
                                             EncoderZeros zeros, int threads,
                                             base::Progress* progress = nullptr);

/// The trajectory as a table that `capstan-cli simulate --trajectory` reads: columns t, q1 … qn in SI.
std::string trajectoryText(const NextExperiment& experiment);

/// The proposal in one sentence.
std::string sentenceOf(const NextExperiment& experiment);

}  // namespace capstan::diagnosis
