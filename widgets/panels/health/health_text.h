#pragma once

#include <QString>

#include "core/tracking/health.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Verdict with its sign: "✓ pass", "! cautious", "✗ FAIL", "– unknown".
QString verdictText(tracking::HealthVerdict verdict);
/// Colour of a verdict's text.
QColor verdictColour(tracking::HealthVerdict verdict, const Theme& theme);

}  // namespace capstan::widgets
