#pragma once

#include <QString>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// "Backlash of the cable drive"; an effect that no hypothesis is known of by its own name.
QString titleOf(const std::string& effect);

/// "joint 2 (elbow)", "whole arm", "cameras"; names of `robot`.
QString placeOf(const std::string& effect, int joint, const robot::Description& robot);

/// What a report comes to, in a line: "Found: backlash of the cable drive, joint 2 (elbow)".
QString headlineOf(const diagnosis::Report& report);

/// Which of a report's channels these are: "q2 (elbow)", behind the recording where there are several.
QString channelTitle(const diagnosis::Report& report, const diagnosis::ChannelReport& channel);

/// The channel to look at where no cause says which: that of the process that goes on where something stays
/// unexplained, else the one in which a single variable explains most of what is beyond the sensor's noise.
std::string channelWorthSeeing(const diagnosis::Report& report);

/// "+3.1 %"; a dash where it is not known.
QString percentText(double share, int decimals = 0, bool sign = false);

}  // namespace capstan::widgets
