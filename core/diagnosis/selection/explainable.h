#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/residuals/residual_process.h"
#include "core/diagnosis/selection/measured_regression.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {

/// Compares the held-out residual of the selected model with the residuals of regressions on the recorded
/// signals, for each joint encoder (without encoders: for each axis of the tip), all recordings together. The
/// regressions are measuredRegression(), and residualProcess() of the residual of the refitted nominal robot.
/// A model of physical effects need not be as good as the process; if it is materially worse, something is
/// unexplained. The channel with the largest ratio of residual to noise comes first.
std::vector<Explainable> explainableOf(const FitData& data, const Selection& selection,
                                       const robot::Description& nominal, base::Progress* progress);
inline constexpr double kExplainableEnd = 0.93;  ///< progress at the end of explainableOf()

/// Comparison for one channel. `refitted`, `named`: mean squares of its held-out residuals without and with
/// the effects. `process_mean_square`: of the residual that `process` belongs to.
Explainable explainableFrom(const Channel& channel, double refitted, double named,
                            const MeasuredRegression& linear, double process_mean_square,
                            const ResidualProcess& process);

/// True if a regression explains materially more of some channel than the selected model: Explainable::share
/// is below kNear, and the difference of the residuals exceeds the tolerance.
bool fallsShort(const std::vector<Explainable>& channels, const Tolerance& tolerance);
inline constexpr double kNear = 0.9;

/// True if a regression explains something of at least one channel, and of no channel more than the selected
/// model.
bool isAllThatCanBe(const std::vector<Explainable>& channels);

}  // namespace capstan::diagnosis
