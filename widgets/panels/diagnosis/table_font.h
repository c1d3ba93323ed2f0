#pragma once

namespace capstan::widgets {

/// Size of the font of a report's tables [pt].
inline constexpr double kTableFont = 10.0;

}  // namespace capstan::widgets
