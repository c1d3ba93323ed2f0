#pragma once

#include <functional>
#include <vector>

#include "core/diagnosis/residuals/residual_process.h"

namespace capstan::diagnosis {

/// residualProcess() that calls `part` after each of its parts, at most kProcessParts times, for a progress.
ResidualProcess residualProcessInParts(const Channel& channel, const std::vector<Variable>& variables,
                                       const ProcessOptions& options, const base::Progress* progress,
                                       const std::function<void()>& part);
/// Number of parts: two halves, each with its trial fits, its fit and its score.
inline constexpr std::size_t kProcessParts = 8;

}  // namespace capstan::diagnosis
