#pragma once

#include "core/base/table.h"
#include "core/studies/cramer_rao_study.h"
#include "core/studies/noise_study.h"

namespace capstan::studies {

/// Ratio of the filter's RMS to the bound that is to be reached.
inline constexpr double kCramerRaoGoal = 1.10;

/// A row a joint and measurement noise.
base::Table closenessOf(const CramerRaoStudy& study, const CramerRaoOptions& options);
/// A row a variant.
base::Table noisesOf(const NoiseStudy& study, const NoiseStudyOptions& options);

}  // namespace capstan::studies
