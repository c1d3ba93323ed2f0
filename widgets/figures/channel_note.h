#pragma once

#include <QString>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// How much of what can be explained of a channel's residual the effects explain, as a sentence; empty: not
/// known.
QString explainedNote(const diagnosis::Report& report, const diagnosis::ChannelReport& channel);

/// Note of a figure of this channel's residual: name of the recording and explainedNote().
QString channelNote(const diagnosis::Report& report, const diagnosis::ChannelReport& channel);

}  // namespace capstan::widgets
