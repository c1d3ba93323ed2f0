#pragma once

#include <string>

#include "app/monitor/colours.h"
#include "core/live/feed/feed_reader.h"

namespace capstan::monitor {

/// State of the session at a glance.
struct Banner {
  std::string word;            ///< "TRACKING"
  std::string detail;          ///< the reason, in words
  Colour colour = kQuiet;      ///< of the bar
  Colour estimate = kWarning;  ///< of arm and tip
  bool certain = false;        ///< the estimate rests on the cameras: without its ellipse, not dashed
  float light = 1.0F;          ///< of the images: below 1 where they are old
};

/// `silent_for`: time since the last state of the session, `images_for`: since its last images [s].
Banner bannerOf(live::FeedReader::Link link, live::FeedRun run, const std::string& fault,
                const live::FeedState& state, double silent_for, double images_for);

}  // namespace capstan::monitor
