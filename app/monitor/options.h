#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/monitor/layout.h"
#include "core/live/feed/feed_segment.h"

namespace capstan::monitor {

/// Arguments of capstan-monitor.
struct Options {
  std::string feed = live::kFeedName;
  std::string layout = "side-by-side";
  std::string size = "1280x720";
  int display = 1;  ///< number in --list-displays
  bool list_displays = false, full_screen = false;
  bool swapped = false, stretched = false, numbers = false, latency = false, help_shown = false;
  long images = 0;        ///< end after so many; 0: no
  double duration = 0.0;  ///< end after this time [s]; 0: no
  bool redraw = false;
  std::string report, screenshot;
};

void addOptions(CLI::App& cli, Options& options);

/// Width and height of --size [px]. Throws base::InputError.
std::array<int, 2> windowSizeOf(const std::string& text);

}  // namespace capstan::monitor
