#pragma once

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// Reduction of the RMS residual of channel c on held-out blocks, with 95 % intervals by 1000 block
/// bootstraps.
Gain gainOf(const FitData& data, const BlockSquares& before, const BlockSquares& after, int c);
Gain gainOf(const ComparedChannel& channel, const BlockSquares& before, const BlockSquares& after, int c);

}  // namespace capstan::diagnosis
