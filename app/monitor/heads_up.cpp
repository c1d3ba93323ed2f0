#include "app/monitor/heads_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace capstan::monitor {

namespace {

constexpr Colour kPanel = kBlack.faded(0.55F);

float toFloat(int value) { return static_cast<float>(value); }

/// Base line of a line of text in the middle of a row.
float baseLine(const Font& font, float top, float height) {
  return top + 0.5F * height + 0.36F * toFloat(font.pixels);
}

/// A value with its two sigma, aligned on the decimal point; "–" where it is not known.
std::string numberRow(std::string_view name, double value, double sigma, const char* unit, int decimals) {
  if (!std::isfinite(value)) return fmt::format("{:<10}{:>8} {:<3}", name, "–", unit);
  const std::string row = fmt::format("{:<10}{:>8.{}f} {:<3}", name, value, decimals, unit);
  return std::isfinite(sigma) ? row + fmt::format(" ± {:.{}f}", 2.0 * sigma, decimals) : row;
}

std::vector<std::string> numberRows(const live::FeedState& state) {
  std::vector<std::string> rows;
  for (int i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    const bool angle = i != 2;
    const auto shown = [angle](double value) { return base::degreesOrMillimetres(value, angle); };
    const std::string_view name = live::textOf(state.joints[joint]);
    rows.push_back(numberRow(name.empty() ? fmt::format("q{}", i + 1) : std::string(name.substr(0, 10)),
                             shown(state.q[joint]), shown(state.q_sigma[joint]), angle ? "deg" : "mm", 2));
  }
  constexpr std::array kAxes = {"tip x", "tip y", "tip z"};
  for (std::size_t i = 0; i < 3; ++i)
    rows.push_back(numberRow(kAxes[i], 1e3 * state.tip[i], 1e3 * state.tip_sigma[i], "mm", 2));
  return rows;
}

/// Lines on a dark panel whose left top corner is `at`.
void sketchPanel(Sketch& sketch, const Font& font, const std::vector<std::string>& rows, Rect at) {
  const float line = 1.35F * toFloat(font.pixels), margin = 0.6F * toFloat(font.pixels);
  float widest = 0.0F;
  for (const std::string& row : rows) widest = std::max(widest, font.width(row));
  at.width = std::min(at.width, static_cast<int>(std::ceil(widest + 2.0F * margin)) + 1);
  at.height = static_cast<int>(line * toFloat(static_cast<int>(rows.size())) + margin);
  sketch.fill(at, kPanel);
  for (std::size_t i = 0; i < rows.size(); ++i)
    sketch.text(font,
                {toFloat(at.x) + margin,
                 baseLine(font, toFloat(at.y) + 0.5F * margin + line * toFloat(static_cast<int>(i)), line)},
                font.fitted(rows[i], toFloat(at.width) - 2.0F * margin), kText);
}

void sketchBar(Sketch& sketch, const Banner& banner, const Rect& bar, const FontAtlas& fonts) {
  sketch.fill(bar, banner.colour);
  const float margin = 0.45F * toFloat(bar.height), right = toFloat(bar.x + bar.width) - margin;
  const float y = baseLine(fonts.bar, toFloat(bar.y), toFloat(bar.height));
  const std::string word = fonts.bar.fitted(banner.word, right - toFloat(bar.x) - margin);
  const float end = sketch.text(fonts.bar, {toFloat(bar.x) + margin, y}, word, kBlack);
  const float room = right - end - margin;
  if (room > 0.0F) sketch.textBefore(fonts.text, {right, y}, fonts.text.fitted(banner.detail, room), kBlack);
}

void sketchHelp(Sketch& sketch, const Pane& pane, const Font& font) {
  const auto& keys = keyHelp();
  const float line = 1.4F * toFloat(font.pixels), margin = toFloat(font.pixels);
  float key_width = 0.0F, action_width = 0.0F;
  for (const KeyHelp& one : keys) {
    key_width = std::max(key_width, font.width(one.key));
    action_width = std::max(action_width, font.width(one.action));
  }
  const float gap = 1.2F * toFloat(font.pixels);
  const float width = key_width + gap + action_width + 2.0F * margin;
  const float height = line * toFloat(static_cast<int>(keys.size())) + 2.0F * margin;
  const float x = toFloat(pane.picture.x) + 0.5F * (toFloat(pane.picture.width) - width);
  const float y = toFloat(pane.picture.y) + 0.5F * (toFloat(pane.picture.height) - height);
  sketch.fill({static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height)},
              kBlack.faded(0.85F));
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const float base = baseLine(font, y + margin + line * toFloat(static_cast<int>(i)), line);
    sketch.text(font, {x + margin, base}, keys[i].key, kCamera);
    sketch.text(font, {x + margin + key_width + gap, base}, keys[i].action, kText);
  }
}

void sketchMessage(Sketch& sketch, const HeadsUp& content, const Rect& area, const FontAtlas& fonts) {
  const float middle = toFloat(area.x) + 0.5F * toFloat(area.width);
  const float y = toFloat(area.y) + 0.5F * toFloat(area.height);
  const float most = 0.94F * toFloat(area.width);
  sketch.textAbout(fonts.bar, {middle, y}, fonts.bar.fitted(content.message, most), kText);
  sketch.textAbout(fonts.text, {middle, y + 1.9F * toFloat(fonts.text.pixels)},
                   fonts.text.fitted(content.hint, most), kMuted);
}

}  // namespace

FontSizes fontSizesFor(const Pane& pane) {
  const int text = std::clamp(std::min(pane.picture.width / 34, pane.picture.height / 22), 9, 60);
  const int numbers = std::clamp(std::min(pane.picture.width / 21, pane.picture.height / 15), 9, 96);
  return {std::clamp(pane.bar.height * 62 / 100, 9, 96), numbers, text};
}

const std::vector<KeyHelp>& keyHelp() {
  static const std::vector<KeyHelp> kKeys = {{"1", "left | right"},
                                             {"2", "top – bottom"},
                                             {"3", "interleaved rows"},
                                             {"4", "red–cyan glasses"},
                                             {"5  6", "left eye, right eye"},
                                             {"S", "swap the eyes"},
                                             {"A", "keep the shape, or fill the half"},
                                             {"O", "circle, arm and tip"},
                                             {"N", "numbers"},
                                             {"L", "latency"},
                                             {"F", "full screen"},
                                             {"D", "next display"},
                                             {"H  F1", "this help"},
                                             {"Q  Esc", "leave"}};
  return kKeys;
}

void sketchPanels(Sketch& sketch, const HeadsUp& content, const live::FeedState& state, const Pane& pane,
                  const FontAtlas& fonts) {
  const Rect& area = pane.picture;
  const int margin = std::max(4, fonts.text.pixels / 2);
  std::vector<std::string> corner;
  for (const std::string& line : {content.eye, content.timing})
    if (!line.empty()) corner.push_back(line);
  if (!corner.empty())
    sketchPanel(sketch, fonts.text, corner, {area.x + margin, area.y + margin, area.width - 2 * margin, 0});
  if (content.numbers) {
    const auto rows = numberRows(state);
    const int height = static_cast<int>(toFloat(fonts.numbers.pixels) *
                                        (1.35F * toFloat(static_cast<int>(rows.size())) + 0.6F));
    sketchPanel(sketch, fonts.numbers, rows,
                {area.x + margin, area.y + area.height - height - margin, area.width - 2 * margin, 0});
  }
}

void sketchBarAndHelp(Sketch& sketch, const HeadsUp& content, const Pane& pane, const FontAtlas& fonts) {
  if (!content.message.empty() && !content.help) sketchMessage(sketch, content, pane.picture, fonts);
  sketchBar(sketch, content.banner, pane.bar, fonts);
  if (content.help) sketchHelp(sketch, pane, fonts.text);
}

}  // namespace capstan::monitor
