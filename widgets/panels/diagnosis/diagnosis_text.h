#pragma once

#include <QString>
#include <QStringList>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// Title of an effect, for example "Backlash of the cable drive"; for an effect without a hypothesis its own
/// name.
QString titleOf(const std::string& effect);

/// Location of an effect: "joint 2 (elbow)", "whole arm", "cameras"; joint names of `robot`.
QString placeOf(const std::string& effect, int joint, const robot::Description& robot);

/// The same after a title: ", joint 2 (elbow)"; nothing for effects whose title names the cameras.
QString placeAfterTitle(const std::string& effect, int joint, const robot::Description& robot);

/// Causes of a tie, the most probable one first: "backlash of the cable drive, joint 2 (elbow)".
QStringList tiedNames(const diagnosis::Tie& tie, const robot::Description& robot);

/// Result of a report in one line: "Found: backlash of the cable drive, joint 2 (elbow)".
QString headlineOf(const diagnosis::Report& report);

/// Title of a channel: "q2 (elbow)", after the name of the recording where a report has several.
QString channelTitle(const diagnosis::Report& report, const diagnosis::ChannelReport& channel);

/// The channel to show if no cause determines it: the channel of an ongoing process if a residual is
/// unexplained, else the channel in which a single variable explains the largest part of the variance beyond
/// the sensor's noise.
std::string channelWorthSeeing(const diagnosis::Report& report);

/// Percentage as "+3.1 %"; a dash where `share` is not finite.
QString percentText(double share, int decimals = 0, bool sign = false);

}  // namespace capstan::widgets
