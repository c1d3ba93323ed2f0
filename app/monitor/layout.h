#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/names.h"

namespace capstan::monitor {

/// How both eyes share the screen.
enum class Layout { kSideBySide, kTopBottom, kInterleaved, kAnaglyph, kLeft, kRight };

/// Pixels of the window, from its top left corner.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
};

/// How the pixels of an eye are mixed with those of the other one.
enum class Mix { kNone, kEvenRows, kOddRows, kRed, kCyan };

struct PaneEye {
  std::size_t eye;  ///< 0 left, 1 right
  Mix mix;
};

/// A part of the window with one bar below it; it shows one eye, or both mixed.
struct Pane {
  Rect picture;  ///< where images may lie
  Rect bar;      ///< state of the session
  std::vector<PaneEye> eyes;
};

/// Panes of a window of `width` x `height` [px]. `swapped`: the eyes are exchanged.
std::vector<Pane> panesOf(Layout layout, int width, int height, bool swapped);

/// The largest part of `area` with the image's shape, in its middle; `stretched`: all of `area`.
Rect fitted(const Rect& area, int image_width, int image_height, bool stretched);

/// Names for the help of --layout: "side-by-side, top-bottom, …".
std::vector<std::string> layoutNames();

}  // namespace capstan::monitor

template <>
struct capstan::base::NamesOf<capstan::monitor::Layout> {
  using L = capstan::monitor::Layout;
  static constexpr std::array value = {std::pair{L::kSideBySide, "side-by-side"},
                                       std::pair{L::kTopBottom, "top-bottom"},
                                       std::pair{L::kInterleaved, "interleaved"},
                                       std::pair{L::kAnaglyph, "anaglyph"},
                                       std::pair{L::kLeft, "left"},
                                       std::pair{L::kRight, "right"}};
};
