#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {

/// What regressions on the recordings' own signals leave of each joint's encoder (without encoders: of each axis of the tip)
/// beside what the selection leaves, on held-out data: measuredRegression(), and residualProcess() of the refitted nominal
/// structure's residual, all recordings together. No named model needs to reach the process; a material distance to it is
/// something unexplained. The channel with most beyond noise first.
std::vector<Explainable> explainableOf(const FitData& data, const Selection& selection,
                                       const robot::Description& nominal, base::Progress* progress);

/// True if a regression explains materially more of some channel than the selection does: less than kNear of what can be
/// explained is named, and the difference is larger than the tolerance.
bool fallsShort(const std::vector<Explainable>& channels, const Tolerance& tolerance);
inline constexpr double kNear = 0.9;

/// True if some regression explains something, and of no channel more than the selection does.
bool isAllThatCanBe(const std::vector<Explainable>& channels);

}  // namespace capstan::diagnosis
