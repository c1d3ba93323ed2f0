#include "widgets/figures/header_layout.h"

#include <QFontMetricsF>
#include <algorithm>

#include "widgets/figures/number_text.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

namespace {

constexpr double kRoomyColumn = 120.0;  ///< greatest column width; then the title gets the room [px]

std::array<double, HeaderLayout::kColumns> leastWidths(const HeaderPoints& points, const QString& reference) {
  const QFontMetricsF names(textFont(points.legend)), numbers(numberFont(points.number));
  const QString legend[] = {reference, nameOf(Quantity::kKinematic), nameOf(Quantity::kCamera),
                            nameOf(Quantity::kUkf), kSigmaName};
  std::array<double, HeaderLayout::kColumns> widths{};
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const double name =
        names.horizontalAdvance(legend[i]) + HeaderLayout::kLeastSample + HeaderLayout::kSampleGap;
    const double number = numbers.horizontalAdvance(i == HeaderLayout::kSigma ? kWidestSigma : kWidestValue);
    widths[i] = HeaderLayout::kGap + std::max(name, number);
  }
  return widths;
}

}  // namespace

HeaderLayout layOutHeader(double left, double right, double widest_title, const HeaderPoints& points,
                          const QString& reference) {
  auto widths = leastWidths(points, reference);
  double columns = 0.0;
  for (const double width : widths) columns += width;
  const double sigma = widths[HeaderLayout::kSigma], room = right - left;

  HeaderLayout layout;
  const bool one_line = columns - sigma + widest_title <= room;
  layout.lines = one_line ? 1 : 2;
  layout.has_sigma = columns + (one_line ? widest_title : 0.0) <= room;
  if (!layout.has_sigma) {
    columns -= sigma;
    widths[HeaderLayout::kSigma] = 0.0;
  }
  const int used = layout.has_sigma ? HeaderLayout::kColumns : HeaderLayout::kColumns - 1;
  const double spare = std::max(0.0, room - columns - (one_line ? widest_title : 0.0)) / used;
  double x = right;
  for (int i = used - 1; i >= 0; --i) {
    const auto column = static_cast<std::size_t>(i);
    const double width = std::max(
        widths[column], std::min(widths[column] + spare, one_line ? kRoomyColumn : widths[column] + spare));
    layout.right[column] = x;
    layout.left[column] = x -= width;
  }
  layout.title_left = left;
  layout.title_right = one_line ? x : right;
  return layout;
}

}  // namespace capstan::widgets
