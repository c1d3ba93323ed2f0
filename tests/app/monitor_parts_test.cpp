// Parts of the stereo monitor without a window: layouts, drawing, words.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/monitor/banner.h"
#include "app/monitor/eye_overlay.h"
#include "app/monitor/heads_up.h"
#include "app/monitor/latency_log.h"
#include "app/monitor/layout.h"
#include "app/monitor/options.h"
#include "app/monitor/sketch.h"
#include "core/base/error.h"

namespace capstan::monitor {
namespace {

using Link = live::FeedReader::Link;

bool inside(const Rect& part, const Rect& whole) {
  return part.x >= whole.x && part.y >= whole.y && part.x + part.width <= whole.x + whole.width &&
         part.y + part.height <= whole.y + whole.height;
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

TEST(MonitorLayout, PanesAreInTheWindowAndApart) {
  for (const auto& [layout, name] : base::NamesOf<Layout>::value)
    for (const auto& [width, height] : {std::pair{1280, 720}, {641, 359}, {160, 160}, {3840, 2160}}) {
      const auto panes = panesOf(layout, width, height, false);
      std::vector<Rect> parts;
      int eyes = 0;
      for (const Pane& pane : panes) {
        for (const Rect& part : {pane.picture, pane.bar}) {
          EXPECT_FALSE(part.empty()) << name;
          EXPECT_TRUE(inside(part, {0, 0, width, height})) << name << " " << width;
          for (const Rect& other : parts) EXPECT_FALSE(overlap(part, other)) << name << " " << width;
          parts.push_back(part);
        }
        eyes += static_cast<int>(pane.eyes.size());
      }
      EXPECT_EQ(eyes, layout == Layout::kLeft || layout == Layout::kRight ? 1 : 2) << name;
    }
}

TEST(MonitorLayout, SwappingExchangesTheEyes) {
  for (const auto& [layout, name] : base::NamesOf<Layout>::value) {
    const auto plain = panesOf(layout, 1280, 720, false), swapped = panesOf(layout, 1280, 720, true);
    for (std::size_t i = 0; i < plain.size(); ++i)
      for (std::size_t k = 0; k < plain[i].eyes.size(); ++k) {
        EXPECT_EQ(plain[i].eyes[k].eye, 1 - swapped[i].eyes[k].eye) << name;
        EXPECT_EQ(plain[i].eyes[k].mix, swapped[i].eyes[k].mix) << name;
      }
  }
  EXPECT_EQ(panesOf(Layout::kLeft, 640, 480, false)[0].eyes[0].eye, 0U);
  EXPECT_EQ(panesOf(Layout::kAnaglyph, 640, 480, false)[0].eyes[0].mix, Mix::kRed) << "red is left";
}

TEST(MonitorLayout, ImagesKeepTheirShapeInTheMiddle) {
  const Rect wide = fitted({100, 50, 640, 360}, 640, 480, false);
  EXPECT_EQ(wide.height, 360);
  EXPECT_EQ(wide.width, 480);
  EXPECT_EQ(wide.x, 100 + 80);
  EXPECT_EQ(wide.y, 50);
  const Rect high = fitted({0, 0, 640, 655}, 640, 480, false);
  EXPECT_EQ(high.width, 640);
  EXPECT_EQ(high.height, 480);
  EXPECT_EQ(high.y, 87);
  EXPECT_EQ(fitted({1, 2, 640, 655}, 640, 480, true).height, 655);
}

TEST(MonitorSketch, TheBorderOfAnEllipseSatisfiesItsEquation) {
  const float a = 40.0F, b = 15.0F, angle = 0.6F;
  const auto border = ellipseBorder({100.0F, 50.0F}, a, b, angle);
  double area = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const double dx = border[i].x - 100.0, dy = border[i].y - 50.0;
    const double along = std::cos(angle) * dx + std::sin(angle) * dy,
                 across = std::cos(angle) * dy - std::sin(angle) * dx;
    EXPECT_NEAR(std::pow(along / a, 2) + std::pow(across / b, 2), 1.0, 1e-4);
    const Point& next = border[(i + 1) % border.size()];
    area += 0.5 * (border[i].x * next.y - next.x * border[i].y);
  }
  const double n = static_cast<double>(border.size());
  const double polygon = 0.5 * n * std::sin(2.0 * std::numbers::pi / n) * a * b;
  EXPECT_NEAR(area, polygon, 1e-3 * polygon);
}

/// Area of the triangles, weighted with their opacity: that of a triangle is linear between its corners.
double coverage(const Sketch& sketch) {
  const auto& v = sketch.vertices();
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
    const double area = 0.5 * std::abs((v[i + 1].x - v[i].x) * (v[i + 2].y - v[i].y) -
                                       (v[i + 2].x - v[i].x) * (v[i + 1].y - v[i].y));
    sum += area * (v[i].a + v[i + 1].a + v[i + 2].a) / 3.0;
  }
  return sum;
}

TEST(MonitorSketch, ALineCoversItsLengthTimesItsWidth) {
  const std::array<Point, 3> straight = {Point{10.0F, 20.0F}, {40.0F, 60.0F}, {70.0F, 100.0F}};
  Sketch sketch;
  sketch.line(straight, 4.0F, kText);
  EXPECT_NEAR(coverage(sketch), 100.0 * 4.0, 0.1);
  sketch.clear();
  sketch.line(straight, 4.0F, kText, false, 10.0F);
  EXPECT_NEAR(coverage(sketch), 50.0 * 4.0, 0.1) << "every other part of a dashed line";
  sketch.clear();
  sketch.line(ellipseBorder({0.0F, 0.0F}, 90.0F, 90.0F, 0.0F), 4.0F, kText, true);
  EXPECT_NEAR(coverage(sketch), 2.0 * std::numbers::pi * 90.0 * 4.0, 5.0);
}

TEST(MonitorSketch, OverlaysLieOnTheImageWhereverItIsShown) {
  live::FeedEye eye;
  eye.marker_found = 1;
  eye.circle = {99.5, 49.5, 20.0};
  Sketch sketch;
  const Rect rect{300, 100, 640, 960};  // 640 x 480, stretched in y
  sketchEye(sketch, eye, {}, rect, {640, 480});
  ASSERT_FALSE(sketch.vertices().empty());
  float left = 1e9F, right = -1e9F, top = 1e9F, bottom = -1e9F;
  for (const Vertex& v : sketch.vertices()) {
    left = std::min(left, v.x), right = std::max(right, v.x);
    top = std::min(top, v.y), bottom = std::max(bottom, v.y);
  }
  EXPECT_NEAR(0.5F * (left + right), 300.0 + 100.0, 0.01) << "pixel centres are at halves";
  EXPECT_NEAR(0.5F * (top + bottom), 100.0 + 2.0 * 50.0, 0.01);
  EXPECT_NEAR((bottom - top) / (right - left), 2.0, 0.35) << "it is stretched as the image is";
}

Banner bannerFor(live::FeedTracking tracking, Link link = Link::kLive,
                 live::FeedRun run = live::FeedRun::kRunning, double silent_for = 0.0,
                 double images_for = 0.0) {
  live::FeedState state;
  state.number = 1;
  state.tracking = tracking;
  state.uncertain_for = 2.34;
  for (live::FeedEye& eye : state.eyes) eye.image = live::FeedImage::kShown;
  live::setText(state.words, "both lost");
  return bannerOf(link, run, "no feed", state, silent_for, images_for);
}

TEST(MonitorBanner, SaysWhatTheEstimateRestsOn) {
  using live::FeedTracking;
  const Banner tracking = bannerFor(FeedTracking::kTracking), occluded = bannerFor(FeedTracking::kOccluded);
  EXPECT_EQ(tracking.word, "TRACKING");
  EXPECT_TRUE(tracking.certain);
  EXPECT_EQ(occluded.word, "OCCLUDED 2.3 s");
  EXPECT_FALSE(occluded.certain);
  EXPECT_NE(occluded.detail.find("both lost"), std::string::npos);
  EXPECT_NE(tracking.colour.r, occluded.colour.r) << "another colour";
  EXPECT_EQ(bannerFor(FeedTracking::kUnregistered).word, "NOT REGISTERED");
  EXPECT_EQ(bannerFor(FeedTracking::kRejected).word, "CAMERA REJECTED 2.3 s");
}

TEST(MonitorBanner, SaysWhatIsWrongWithTheSession) {
  using live::FeedRun;
  using live::FeedTracking;
  constexpr auto kTracking = FeedTracking::kTracking;
  EXPECT_EQ(bannerFor(kTracking, Link::kWaiting).word, "WAITING");
  EXPECT_EQ(bannerFor(kTracking, Link::kEnded).word, "SESSION ENDED");
  EXPECT_EQ(bannerFor(kTracking, Link::kRefused).detail, "no feed");
  EXPECT_EQ(bannerFor(kTracking, Link::kLive, FeedRun::kPaused).word, "PAUSED");
  EXPECT_EQ(bannerFor(kTracking, Link::kLive, FeedRun::kRunning, 3.0).word, "NO DATA 3.0 s");
  const Banner frozen = bannerFor(kTracking, Link::kLive, FeedRun::kRunning, 0.0, 12.0);
  EXPECT_EQ(frozen.word, "NO IMAGES 12 s");
  EXPECT_LT(frozen.light, 1.0F) << "old images are dimmed";
}

TEST(MonitorFont, CutsTextsAtWholeCharacters) {
  const FontAtlas atlas = makeFontAtlas(20, 30, 16);
  EXPECT_FLOAT_EQ(atlas.numbers.width("0000"), atlas.numbers.width("11.±")) << "digits of one width";
  const std::string text = "tip ± 1.4 mm – both lost";
  EXPECT_EQ(atlas.text.fitted(text, 1000.0F), text);
  for (float most = 5.0F; most < atlas.text.width(text); most += 7.0F) {
    const std::string cut = atlas.text.fitted(text, most);
    EXPECT_LE(atlas.text.width(cut), most);
    const std::string kept = cut.substr(0, cut.size() - std::min(cut.size(), std::string("…").size()));
    EXPECT_EQ(text.rfind(kept, 0), 0U) << cut;
  }
}

TEST(MonitorFont, ReadsUtf8AndWhatIsNone) {
  std::string_view text = "aσ…\xFF\xCF";
  for (const char32_t expected : {U'a', U'σ', U'…', U'?', U'?'}) EXPECT_EQ(takeCharacter(text), expected);
  EXPECT_TRUE(text.empty());
}

TEST(MonitorLatency, IsThatOfTheLastImages) {
  LatencyLog log;
  EXPECT_EQ(log.summary().count, 0U);
  for (int i = 0; i <= 100; ++i) log.add(1e-3 * i);
  EXPECT_NEAR(log.summary().median, 0.050, 1e-12);
  EXPECT_NEAR(log.summary().high, 0.099, 1e-12);
  EXPECT_NEAR(log.summary().most, 0.100, 1e-12);
  for (int i = 0; i < 5000; ++i) log.add(0.007);
  EXPECT_EQ(log.summary().count, 5101U);
  EXPECT_NEAR(log.summary().most, 0.007, 1e-12) << "the first ones are forgotten";
}

TEST(MonitorOptions, AWindowsSizeIsTwoNumbers) {
  EXPECT_EQ(windowSizeOf("1280x720"), (std::array{1280, 720}));
  for (const char* wrong : {"", "1280", "1280x", "1280x720x3", "100x720", "1280x99999", "-5x300", "axb"})
    EXPECT_THROW(windowSizeOf(wrong), base::InputError) << wrong;
}

}  // namespace
}  // namespace capstan::monitor
