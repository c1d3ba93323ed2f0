#include "app/monitor/options.h"

#include <cstdio>

#include "core/base/error.h"

namespace capstan::monitor {

void addOptions(CLI::App& cli, Options& options) {
  cli.add_option("--feed", options.feed,
                 "name of the session's feed, as after --monitor-feed of capstan and capstan-cli")
      ->capture_default_str();
  cli.add_option("--layout", options.layout,
                 "side-by-side, top-bottom, interleaved (even rows left, odd rows right),\n"
                 "anaglyph (red and cyan glasses), left or right (one eye)")
      ->capture_default_str()
      ->check(CLI::IsMember(layoutNames()));
  cli.add_flag("--swap", options.swapped, "exchange the eyes");
  cli.add_flag(
      "--stretch", options.stretched,
      "fill each eye's part of the screen, for displays that widen it again; default: keep the shape");
  cli.add_flag("--full-screen", options.full_screen, "fill the display, at its refresh rate");
  cli.add_option("--display", options.display, "number of the display to open on, see --list-displays")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  cli.add_flag("--list-displays", options.list_displays,
               "print number, name, size and refresh rate of the displays");
  cli.add_option("--size", options.size, "width x height of the window [px]")->capture_default_str();
  cli.add_flag("--numbers", options.numbers, "begin with the joints and the tip in numbers");
  cli.add_flag("--latency", options.latency, "begin with the latency shown");
  cli.add_flag("--keys", options.help_shown, "begin with the help of the keys");
  cli.add_option("--frames", options.images, "end after this number of pairs of images; default: run on")
      ->check(CLI::Range(1L, 1'000'000'000L));
  cli.add_option("--duration", options.duration, "end after this time [s]; default: run on")
      ->check(CLI::Range(0.1, 86400.0));
  cli.add_flag("--redraw", options.redraw,
               "draw all the time, also without news, to measure the drawing rate");
  cli.add_option("--screenshot", options.screenshot, "save the last picture (.png) at the end");
  cli.add_option("--report", options.report,
                 "save rates and latency as JSON at the end; - for standard output");
  cli.footer(
      "Keys: 1-6 layouts, F full screen, N numbers, H help, Q or Esc leave.\n"
      "Examples:\n"
      "  capstan-monitor                             (before or after Capstan; press Monitor there)\n"
      "  capstan-monitor --full-screen --display 2 --layout top-bottom\n"
      "  capstan-monitor --layout left & capstan-monitor --layout right     (one eye a window)");
}

std::array<int, 2> windowSizeOf(const std::string& text) {
  constexpr int kLeast = 160, kMost = 7680;
  const auto good = [](int side) { return side >= kLeast && side <= kMost; };
  int width = 0, height = 0, used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || !good(width) || !good(height))
    throw base::InputError(
        {{}, 0, "--size", text, "is not WxH with sides of 160 to 7680 px", "Write it as 1280x720"});
  return {width, height};
}

}  // namespace capstan::monitor
