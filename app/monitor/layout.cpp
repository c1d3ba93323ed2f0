#include "app/monitor/layout.h"

#include <algorithm>

namespace capstan::monitor {

namespace {

/// A bar is legible at two metres, and never more than a tenth of the pane.
int barHeight(int width, int height) { return std::clamp(width / 14, 1, std::max(height / 11, 1)); }

Pane paneOf(const Rect& area, std::vector<PaneEye> eyes) {
  const int bar = std::min(barHeight(area.width, area.height), area.height);
  Pane pane;
  pane.picture = {area.x, area.y, area.width, area.height - bar};
  pane.bar = {area.x, area.y + area.height - bar, area.width, bar};
  pane.eyes = std::move(eyes);
  return pane;
}

}  // namespace

std::vector<Pane> panesOf(Layout layout, int width, int height, bool swapped) {
  const std::size_t first = swapped ? 1 : 0, second = 1 - first;
  const Rect whole{0, 0, width, height};
  switch (layout) {
    case Layout::kSideBySide: {
      const int half = width / 2;
      return {paneOf({0, 0, half, height}, {{first, Mix::kNone}}),
              paneOf({width - half, 0, half, height}, {{second, Mix::kNone}})};
    }
    case Layout::kTopBottom: {
      const int half = height / 2;
      return {paneOf({0, 0, width, half}, {{first, Mix::kNone}}),
              paneOf({0, height - half, width, half}, {{second, Mix::kNone}})};
    }
    case Layout::kInterleaved:
      return {paneOf(whole, {{first, Mix::kEvenRows}, {second, Mix::kOddRows}})};
    case Layout::kAnaglyph:
      return {paneOf(whole, {{first, Mix::kRed}, {second, Mix::kCyan}})};
    case Layout::kLeft:
      return {paneOf(whole, {{first, Mix::kNone}})};
    case Layout::kRight:
      return {paneOf(whole, {{second, Mix::kNone}})};
  }
  return {};
}

Rect fitted(const Rect& area, int image_width, int image_height, bool stretched) {
  if (stretched || image_width <= 0 || image_height <= 0) return area;
  Rect fit = area;
  fit.width = std::min(area.width, static_cast<int>(1.0 * area.height * image_width / image_height + 0.5));
  fit.height = std::min(area.height, static_cast<int>(1.0 * fit.width * image_height / image_width + 0.5));
  fit.x += (area.width - fit.width) / 2;
  fit.y += (area.height - fit.height) / 2;
  return fit;
}

std::vector<std::string> layoutNames() {
  std::vector<std::string> names;
  for (const auto& [layout, name] : base::NamesOf<Layout>::value) names.emplace_back(name);
  return names;
}

}  // namespace capstan::monitor
