#pragma once

#include <string>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {

/// Share of the residual beyond noise that the selected effects explain, between 0 and 1:
/// 1 − (S_after − n noise²) / (S_before − n noise²), in the channel with the largest ratio of residual to
/// noise.
double explainedShare(const FitData& data, const Selection& selection);

/// Largest mean square of channel c that noise alone can cause: noise of its sensor and of the simulation's
/// inputs.
double mostByChance(const FitData& data, const Selection& selection, Eigen::Index c);

/// True if the residual of the selected model is more than noise and the tolerance: the mean square of some
/// channel exceeds mostByChance() plus the squared tolerance, and the residual is correlated in time or far
/// above that limit.
bool hasResidual(const FitData& data, const Selection& selection, const Tolerance& tolerance);
inline constexpr double kBeyondNoise = 1.2;  ///< largest ratio of RMS to sensor noise that can be noise alone
/// Smallest explained share at which the effects are the verdict although a residual remains that a
/// regression could explain, unless the effects fallsShort() of the regression.
inline constexpr double kExplains = 0.96;

/// Fills verdict, causes, also_measurable, ties, posterior, explained and summary of the report from the
/// selection; Report::material, explainable and lines are inputs. The σ of a cause's parameter combines
/// three parts: the σ of the fit; 1 % of the parameter, because laws are simplified; and half of the size
/// that the effect has on a robot in good order (Hypothesis::background).
void judge(const FitData& data, const Selection& selection, const robot::Description& robot, Report& report);

}  // namespace capstan::diagnosis
