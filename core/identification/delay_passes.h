#pragma once

#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"

namespace capstan::identification {

/// Identification for cameras whose clock is far off. CameraPose::delay acts by q(t − delay) ≈ q − delay dq,
/// to first order: 20–40 ms come out 1–3.5 ms too small, and the parameters bear it. A delay found that is
/// longer than kOnePassDelay is therefore taken off the times of exposure, and all is identified again from
/// there; each method by the delay that it found itself. Reports are those of the last pass, with the whole
/// delay and the seconds of both.
///
/// The prior is that of CameraPoseOptions, 0 ± delay_sigma for the whole delay: the second pass has its own
/// about what the first found, which is put right afterwards, for the delay, by delay_before · σ² /
/// delay_sigma² with σ = delay_noise, what the delay's estimate itself went by (exact where it is Gaussian;
/// the σ that is stated counts more); what that would do to the other unknowns, less than delay_before · σ /
/// delay_sigma² of their own standard deviations, is excluded.
inline constexpr double kOnePassDelay = 0.005;  // [s], bent by 0.06 ms

/// `data` with cameras that exposed `delay` [s] before their stamps: times, and tip_kin by the motors then.
/// Observations outside the motors' time, or in a gap of theirs, are excluded.
IdentificationData withExposuresEarlier(IdentificationData data, double delay);

/// As identifyDualUkf() and identifyBatch(), in as many passes as the delay asks for.
DualUkfReport identifyDualUkfInPasses(const IdentificationData& data, const ParameterSet& set,
                                      const DualUkfOptions& options = {}, base::Progress* progress = nullptr);
BatchReport identifyBatchInPasses(const IdentificationData& data, const ParameterSet& set,
                                  const BatchOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::identification
