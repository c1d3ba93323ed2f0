#pragma once

#include <QSize>
#include <string_view>

namespace capstan::widgets {

/// Size of a figure on paper. Text keeps its size in points, whatever the figure's.
struct PaperSize {
  static constexpr double kLeast = 40.0, kMost = 1000.0;  ///< of either side [mm]
  static constexpr double kDotsPerInch = 96.0;            ///< of the units that figures are laid out in

  double width_mm = 180.0, height_mm = 120.0;

  /// In units of 1/96 inch, as widgets and pictures count.
  QSize dots() const;
};

/// "WxH" in millimetres, as 88x60 or 180x120.5. Throws base::InputError, naming `option`, for other text or a
/// side outside kLeast…kMost.
PaperSize parsePaperSize(std::string_view text, std::string_view option = "--size");

}  // namespace capstan::widgets
