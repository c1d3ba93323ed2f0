#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/table.h"
#include "core/diagnosis/report/report.h"

/// A report as tables for people: degrees, millimetres, per cent (shown.h).
namespace capstan::diagnosis {

/// The hypothesis' title, "Backlash"; the name itself where there is no such hypothesis.
std::string titleOf(std::string_view effect);
/// "Backlash, joint 2: half width 0.930 ± 0.030 mm".
std::string causeText(const Cause& cause);
/// "q2: RMS 0.894 deg becomes 0.0251 deg, 2.8 % of it (95 %: 2.6 to 3.1 %), on data that were not fitted".
std::string gainText(const Gain& gain);

/// A row a channel: RMS of measured − simulated of the three models, the sensor's noise, fit, and what is
/// left of the RMS on data held out with its 95 % interval; the last columns only where there are causes, the
/// recording only where there are several.
base::Table channelTable(const Report& report);
/// The nominal model's numbers before and after the refit, those that moved first.
base::Table refitTable(const Report& report);
/// Hypotheses of each round, the likeliest first, `most` of them a round; how many are omitted, the note
/// says.
base::Table rankingTable(const Report& report, std::size_t most = 12);
/// RMS of the Kalman filter's joints with the three models; no rows where it was not requested.
base::Table filterTable(const Report& report);
/// Lines of the residual's spectrum.
base::Table lineTable(const Report& report);
/// What a Gaussian process found the residual to depend on: the first variable, and what is weakly relevant
/// at least.
base::Table processTable(const ResidualProcess& process);

}  // namespace capstan::diagnosis
