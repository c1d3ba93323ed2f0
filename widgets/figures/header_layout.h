#pragma once

#include <array>

namespace capstan::widgets {

/// Font sizes in a figure's header rows [typographic points].
struct HeaderPoints {
  double title = 11.0, legend = 11.0, number = 12.0;
};

/// Positions of title and columns. All rows of a figure share one layout, so that decimal points line up.
/// Columns from left to right: true, kinematic, camera, UKF, ±2σ.
struct HeaderLayout {
  static constexpr int kColumns = 5, kSigma = 4;
  static constexpr double kGap = 10.0;          ///< gap left of each column [px]
  static constexpr double kLeastSample = 16.0;  ///< least length of a legend's line [px]
  static constexpr double kSampleGap = 5.0;     ///< gap between that line and its name [px]

  int lines = 1;          ///< 2: the title is above the numbers
  bool has_sigma = true;  ///< false: no room for the ±2σ column
  double title_left = 0.0, title_right = 0.0;
  std::array<double, kColumns> left{}, right{};
};

/// Computes the layout. Each column is as wide as its widest possible text; the last one ends at `right`. The
/// first of these that fits is used: one line; one line without ±2σ; two lines; two lines without ±2σ.
/// `widest_title`: width of the widest title of all rows [px]. `reference`: name of the first column.
HeaderLayout layOutHeader(double left, double right, double widest_title, const HeaderPoints& points,
                          const QString& reference);

}  // namespace capstan::widgets
