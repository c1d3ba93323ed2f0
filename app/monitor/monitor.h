#pragma once

#include <atomic>
#include <string>

#include "app/monitor/banner.h"
#include "app/monitor/font.h"
#include "app/monitor/heads_up.h"
#include "app/monitor/latency_log.h"
#include "app/monitor/options.h"
#include "app/monitor/painter.h"
#include "app/monitor/window.h"
#include "core/live/feed/feed_reader.h"

namespace capstan::monitor {

/// What the monitor did, for --report and the line at exit.
struct Report {
  double seconds = 0.0;
  long drawn = 0, images = 0, sessions = 0;
  std::uint64_t overtaken = 0;  ///< copies that the session overtook, and that were read again
  LatencyLog::Summary latency;
  std::string renderer;
};

/// The stereo monitor: reads a session's feed and draws it, at most once per refresh of the display.
class Monitor {
 public:
  Monitor(const Options& options, Window& window);
  /// Until a key, a closed window, --frames, --duration or `stop`.
  Report run(const std::atomic<bool>& stop);
  /// The last picture. Throws base::InputError if it cannot be written.
  void save(const std::string& png);

 private:
  struct Session {  // a source of a feed
    std::uint64_t feed, number;
    bool operator==(const Session&) const = default;
  };
  void press(int key);
  bool read();
  bool due() const;
  bool mayDraw() const;
  void draw();
  void drawPane(const Pane& pane);
  void drawOverlay(const Pane& pane);
  HeadsUp headsUpOf(const Pane& pane) const;
  std::string timing() const;
  double since(std::int64_t then_ns) const;

  Options options_;
  Window& window_;
  live::FeedReader reader_;
  live::FeedFrame frame_;
  Painter painter_;
  FontAtlas fonts_;
  FontSizes sizes_{};
  Sketch sketch_;
  Layout layout_;
  bool overlay_ = true, leaving_ = false, fresh_image_ = false, changed_ = true;
  Banner banner_;
  std::int64_t begin_ns_ = 0, now_ns_ = 0, state_ns_ = 0, image_ns_ = 0, drawn_ns_ = 0;
  Session session_{};
  LatencyLog latency_;
  Report report_;
};

}  // namespace capstan::monitor
