#pragma once

#include <string>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {

/// How much of what is beyond noise the named effects take off: of the channel that had most of it,
/// 1 − (S_after − n noise²) / (S_before − n noise²), between 0 and 1.
double explainedShare(const FitData& data, const Selection& selection);

/// Mean square of channel c up to which there is nothing in it but noise: of its sensor,
/// and of those that drive the simulation.
double mostByChance(const FitData& data, const Selection& selection, Eigen::Index c);

/// True if the residual of the selection's model has more than noise, chance and the tolerance in it: the mean square of
/// some channel is beyond them, and it lasts from sample to sample or is far beyond them.
bool hasResidual(const FitData& data, const Selection& selection, const Tolerance& tolerance);
inline constexpr double kBeyondNoise = 1.2;  ///< RMS, in noise of the sensor
/// Share that effects must explain before they, and not something unknown, are the verdict, where something
/// is left.
inline constexpr double kExplains = 0.96;

/// Fills verdict, causes, also_measurable, ties, posterior, explained and summary of the report; Report::material is given. The σ
/// of a cause's number is that of the fit, 1 % of the number, which a simplified law leaves at best, and half of the
/// effect's background size.
void judge(const FitData& data, const Selection& selection, const robot::Description& robot, Report& report);

}  // namespace capstan::diagnosis
