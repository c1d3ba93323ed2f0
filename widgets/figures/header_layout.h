#pragma once

#include <array>

namespace capstan::widgets {

/// Sizes of the texts in a figure's header rows [typographic points].
struct HeaderPoints {
  double title = 11.0, legend = 11.0, number = 12.0;
};

/// Where title and columns lie; all rows of a figure share one, so that decimals stand below each other.
/// Columns from left to right: true, kinematic, camera, UKF, ±2σ.
struct HeaderLayout {
  static constexpr int kColumns = 5, kSigma = 4;
  static constexpr double kGap = 10.0;          ///< left of each column [px]
  static constexpr double kLeastSample = 16.0;  ///< of a legend's line [px]
  static constexpr double kSampleGap = 5.0;     ///< between it and its name [px]

  int lines = 1;          ///< 2: the title stands above the numbers
  bool has_sigma = true;  ///< false: no room for the ±2σ column
  double title_left = 0.0, title_right = 0.0;
  std::array<double, kColumns> left{}, right{};
};

/// Each column is as wide as the widest text that can occur in it; the last ends at `right`. What fits first
/// of: one line; one line without ±2σ; two lines; two lines without ±2σ. `widest_title` [px] of all rows.
HeaderLayout layOutHeader(double left, double right, double widest_title, const HeaderPoints& points);

}  // namespace capstan::widgets
