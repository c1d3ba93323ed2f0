#pragma once

#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"

namespace capstan::identification {

/// Identification for cameras with a large clock offset. CameraPose::delay acts to first order,
/// q(t − delay) ≈ q − delay dq: a delay of 20–40 ms is estimated 1–3.5 ms too small, and the parameters
/// become biased. When the estimated delay is longer than kOnePassDelay, it is subtracted from the times of
/// exposure, and a second pass identifies again. Each method uses its own estimate of the delay. The report
/// is that of the last pass, with the total delay and the computing time of both passes.
///
/// The prior of CameraPoseOptions, 0 ± delay_sigma, holds for the total delay, but the second pass applies it
/// to the correction only. The reported delay is corrected for this by −delay_before · σ² / delay_sigma² with
/// σ = delay_noise, the σ that the estimator used (exact for Gaussian errors; the stated σ is larger). The
/// effect on the other unknowns is neglected: it is below delay_before · σ / delay_sigma² of their standard
/// deviations.
inline constexpr double kOnePassDelay = 0.005;  // [s]; the first-order error is then 0.06 ms

/// `data` with exposures `delay` [s] before the time stamps: the times are moved and tip_kin is computed
/// again. Observations outside the motor samples, or in one of their gaps, are excluded.
IdentificationData withExposuresEarlier(IdentificationData data, double delay);

/// Run identifyDualUkf() and identifyBatch() in one pass or two, depending on the estimated delay.
DualUkfReport identifyDualUkfInPasses(const IdentificationData& data, const ParameterSet& set,
                                      const DualUkfOptions& options = {}, base::Progress* progress = nullptr);
BatchReport identifyBatchInPasses(const IdentificationData& data, const ParameterSet& set,
                                  const BatchOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::identification
