#pragma once

#include <QSize>
#include <string_view>

namespace capstan::widgets {

/// Size of a figure on paper. Font sizes in points do not depend on it.
struct PaperSize {
  static constexpr double kLeast = 40.0, kMost = 1000.0;  ///< limits of either side [mm]
  static constexpr double kDotsPerInch = 96.0;            ///< figures are laid out in units of 1/96 inch

  double width_mm = 180.0, height_mm = 120.0;

  /// The size in units of 1/96 inch, the pixels of widgets and images.
  QSize dots() const;
};

/// Parses "WxH" in millimetres, for example 88x60 or 180x120.5. Throws base::InputError, naming `option`, for
/// other text or a side outside kLeast…kMost.
PaperSize parsePaperSize(std::string_view text, std::string_view option = "--size");

}  // namespace capstan::widgets
