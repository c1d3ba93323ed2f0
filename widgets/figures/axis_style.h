#pragma once

class QCPAxis;

namespace capstan::widgets {

struct Theme;

/// Colours and fonts of an axis of a small plot in a panel.
void styleAxis(QCPAxis& axis, const Theme& theme);

}  // namespace capstan::widgets
