#pragma once

#include "core/base/table.h"
#include "core/studies/cramer_rao_study.h"
#include "core/studies/noise_study.h"

namespace capstan::studies {

/// Goal: largest ratio of the filter's RMS to the bound.
inline constexpr double kCramerRaoGoal = 1.10;

/// Table of the filter against the bound, one row per joint and measurement noise.
base::Table closenessOf(const CramerRaoStudy& study, const CramerRaoOptions& options);
/// Table of the noise study, one row per variant.
base::Table noisesOf(const NoiseStudy& study, const NoiseStudyOptions& options);

}  // namespace capstan::studies
