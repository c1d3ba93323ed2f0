#pragma once

#include <string>
#include <vector>

#include "app/monitor/banner.h"
#include "app/monitor/font.h"
#include "app/monitor/layout.h"
#include "app/monitor/sketch.h"

namespace capstan::monitor {

/// What is written over a pane.
struct HeadsUp {
  Banner banner;
  std::string eye;      ///< label in the corner; empty: none
  std::string message;  ///< in the middle, where there is no image; empty: none
  std::string hint;     ///< below it
  std::string timing;   ///< line about latency; empty: none
  bool numbers = false;
  bool help = false;
};

/// Sizes of the fonts for a pane [px].
struct FontSizes {
  int bar, numbers, text;
  bool operator==(const FontSizes&) const = default;
};
FontSizes fontSizesFor(const Pane& pane);

/// A key of the monitor and what it does, for the help.
struct KeyHelp {
  const char* key;
  const char* action;
};
const std::vector<KeyHelp>& keyHelp();

/// Label of the eye, latency and numbers: below circle, arm and tip.
void sketchPanels(Sketch& sketch, const HeadsUp& content, const live::FeedState& state, const Pane& pane,
                  const FontAtlas& fonts);
/// State of the session, message, help: above them.
void sketchBarAndHelp(Sketch& sketch, const HeadsUp& content, const Pane& pane, const FontAtlas& fonts);

}  // namespace capstan::monitor
