#include "app/monitor/monitor.h"

#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "app/monitor/eye_overlay.h"
#include "core/base/error.h"
#include "core/live/feed/feed_clock.h"

namespace capstan::monitor {

using Link = live::FeedReader::Link;
using live::FeedImage;

namespace {

constexpr double kWatch = 0.001;             // between looks for news of a live session [s]
constexpr double kIdleWatch = 0.05;          // while there is none [s]
constexpr std::int64_t kTick = 200'000'000;  // between pictures without news, so that times count on [ns]

std::string imageFault(FeedImage image) {
  switch (image) {
    case FeedImage::kTooLarge:
      return fmt::format("the image is larger than {} x {}", live::kFeedWidth, live::kFeedHeight);
    case FeedImage::kFormat:
      return "the image is neither 8-bit grey nor BGR";
    case FeedImage::kNoMemory:
      return "the machine has no shared memory left for images";
    default:
      return "no image from this camera";
  }
}

}  // namespace

Monitor::Monitor(const Options& options, Window& window)
    : options_(options),
      window_(window),
      reader_(options.feed),
      layout_(base::fromName<Layout>(options.layout).value_or(Layout::kSideBySide)) {
  report_.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

double Monitor::since(std::int64_t then_ns) const { return 1e-9 * static_cast<double>(now_ns_ - then_ns); }

Report Monitor::run(const std::atomic<bool>& stop) {
  begin_ns_ = now_ns_ = live::feedNow();
  while (!stop && !leaving_ && !window_.closed()) {
    window_.wait(options_.redraw ? 0.0 : reader_.link() == Link::kLive ? kWatch : kIdleWatch);
    while (const int key = window_.takeKey()) press(key);
    now_ns_ = live::feedNow();
    changed_ = read() || changed_;
    changed_ = window_.takeExposed() || changed_ || options_.redraw || now_ns_ - drawn_ns_ > kTick;
    if (changed_ && mayDraw()) draw();
    if (due()) break;
  }
  report_.seconds = 1e-9 * static_cast<double>(live::feedNow() - begin_ns_);
  report_.overtaken = reader_.overtaken();
  report_.latency = latency_.summary();
  return report_;
}

/// Where swaps do not wait for the display (software renderers), a fast session could have more images drawn
/// than the display shows. Three quarters of its period leave the choice to swaps that do wait.
bool Monitor::mayDraw() const {
  return options_.redraw || since(drawn_ns_) >= 0.75 * window_.refreshPeriod();
}

bool Monitor::due() const {
  return (options_.images > 0 && report_.images >= options_.images) ||
         (options_.duration > 0.0 && since(begin_ns_) >= options_.duration);
}

/// Takes news of the session. False: none.
bool Monitor::read() {
  const Link before = reader_.link();
  const bool fresh = reader_.read(frame_, now_ns_);
  if (!fresh) return reader_.link() != before;
  state_ns_ = now_ns_;
  if (const Session session{reader_.feeds(), frame_.state.session}; session != session_) {
    session_ = session;
    ++report_.sessions;
    image_ns_ = now_ns_;
    for (std::size_t eye = 0; eye < 2; ++eye) painter_.setImage(eye, {});
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    if (frame_.state.eyes[eye].image == FeedImage::kUnchanged) continue;
    painter_.setImage(eye, frame_.images[eye]);
    if (frame_.images[eye].empty()) continue;
    fresh_image_ = true;
    image_ns_ = now_ns_;
  }
  return true;
}

void Monitor::press(int key) {
  changed_ = true;
  const auto flip = [](bool& value) { value = !value; };
  switch (key) {
    case GLFW_KEY_1:
      layout_ = Layout::kSideBySide;
      break;
    case GLFW_KEY_2:
      layout_ = Layout::kTopBottom;
      break;
    case GLFW_KEY_3:
      layout_ = Layout::kInterleaved;
      break;
    case GLFW_KEY_4:
      layout_ = Layout::kAnaglyph;
      break;
    case GLFW_KEY_5:
      layout_ = Layout::kLeft;
      break;
    case GLFW_KEY_6:
      layout_ = Layout::kRight;
      break;
    case GLFW_KEY_S:
      flip(options_.swapped);
      break;
    case GLFW_KEY_A:
      flip(options_.stretched);
      break;
    case GLFW_KEY_O:
      flip(overlay_);
      break;
    case GLFW_KEY_N:
      flip(options_.numbers);
      break;
    case GLFW_KEY_L:
      flip(options_.latency);
      break;
    case GLFW_KEY_F:
      window_.toggleFullScreen();
      break;
    case GLFW_KEY_D:
      window_.nextDisplay();
      break;
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
      flip(options_.help_shown);
      break;
    case GLFW_KEY_Q:
    case GLFW_KEY_ESCAPE:
      leaving_ = true;
      break;
    default:
      break;
  }
}

void Monitor::draw() {
  const auto [width, height] = window_.size();
  if (width <= 0 || height <= 0) return;  // iconified
  const auto panes = panesOf(layout_, width, height, options_.swapped);
  if (const FontSizes sizes = fontSizesFor(panes[0]); sizes != sizes_) {
    sizes_ = sizes;
    fonts_ = makeFontAtlas(sizes.bar, sizes.numbers, sizes.text);
    painter_.setAtlas(fonts_);
  }
  banner_ = bannerOf(reader_.link(), reader_.run(), reader_.fault(), frame_.state, since(state_ns_),
                     since(image_ns_));
  painter_.begin(width, height, window_.firstRow());
  for (const Pane& pane : panes) drawPane(pane);
  window_.swap();
  changed_ = false;
  drawn_ns_ = live::feedNow();
  ++report_.drawn;
  if (!std::exchange(fresh_image_, false)) return;
  ++report_.images;
  latency_.add(1e-9 * static_cast<double>(drawn_ns_ - frame_.state.published_ns));
}

void Monitor::drawPane(const Pane& pane) {
  for (const PaneEye& one : pane.eyes) {
    const cv::Size image = painter_.imageSize(one.eye);
    if (image.empty()) continue;
    const Rect rect = fitted(pane.picture, image.width, image.height, options_.stretched);
    painter_.mix(one.mix);
    painter_.drawImage(one.eye, rect, banner_.light);
  }
  const HeadsUp content = headsUpOf(pane);
  const auto [width, height] = window_.size();
  painter_.mix(Mix::kNone);
  sketch_.clear();
  if (!content.help) sketchPanels(sketch_, content, frame_.state, pane, fonts_);
  painter_.draw(sketch_, {0, 0, width, height});
  if (overlay_ && reader_.link() == Link::kLive) drawOverlay(pane);
  painter_.mix(Mix::kNone);
  sketch_.clear();
  sketchBarAndHelp(sketch_, content, pane, fonts_);
  painter_.draw(sketch_, {0, 0, width, height});
}

void Monitor::drawOverlay(const Pane& pane) {
  for (const PaneEye& one : pane.eyes) {
    const cv::Size image = painter_.imageSize(one.eye);
    const Rect rect = fitted(pane.picture, image.width, image.height, options_.stretched);
    painter_.mix(one.mix);
    sketch_.clear();
    sketchEye(sketch_, frame_.state.eyes[one.eye], banner_, rect, image);
    painter_.draw(sketch_, rect);
  }
}

HeadsUp Monitor::headsUpOf(const Pane& pane) const {
  HeadsUp content;
  content.banner = banner_;
  content.numbers = options_.numbers && frame_.state.number > 0;
  content.help = options_.help_shown;
  if (options_.latency) content.timing = timing();
  if (pane.eyes.size() == 1) content.eye = pane.eyes[0].eye == 0 ? "LEFT" : "RIGHT";
  const bool images = std::any_of(pane.eyes.begin(), pane.eyes.end(),
                                  [&](const PaneEye& one) { return !painter_.imageSize(one.eye).empty(); });
  if (images) return content;
  if (reader_.link() == Link::kLive && frame_.state.number > 0) {
    content.message = imageFault(frame_.state.eyes[pane.eyes[0].eye].image);
    content.hint = std::string(live::textOf(frame_.state.title));
  } else {
    content.message = reader_.link() == Link::kRefused ? "Session not readable" : "Waiting for a session";
    content.hint = "In Capstan, press Monitor (feed " + options_.feed + ")";
  }
  return content;
}

std::string Monitor::timing() const {
  const LatencyLog::Summary summary = latency_.summary();
  if (summary.count == 0) return "latency: no image yet";
  return fmt::format("latency {:.1f} ms median, {:.1f} ms 99 %  ·  {:.0f} images/s", 1e3 * summary.median,
                     1e3 * summary.high,
                     static_cast<double>(report_.images) / std::max(since(begin_ns_), 1e-3));
}

void Monitor::save(const std::string& png) {
  draw();  // its back buffer is not defined after a swap
  const auto [width, height] = window_.size();
  painter_.begin(width, height, window_.firstRow());
  for (const Pane& pane : panesOf(layout_, width, height, options_.swapped)) drawPane(pane);
  const cv::Mat picture = painter_.readBack();
  bool saved = false;
  try {
    saved = cv::imwrite(png, picture);
  } catch (const cv::Exception&) {
  }
  if (!saved)
    throw base::InputError(
        {png, 0, {}, {}, "cannot be written", "Give a name that ends in .png, in a folder that exists"});
}

}  // namespace capstan::monitor
