#include "core/live/feed/feed_state.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace capstan::live {

namespace {

constexpr double kFarthest = 1e6;  // of what is drawn, from the image's corner [px]

bool drawable(double value) { return std::isfinite(value) && std::abs(value) < kFarthest; }

template <std::size_t n>
bool drawable(const std::array<double, n>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return drawable(value); });
}

template <std::size_t n>
void cleanText(std::array<char, n>& text) {
  text.back() = '\0';
  for (char& c : text)
    if (c != '\0' && (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)) c = ' ';
}

bool inRange(auto value, auto last) {
  const auto number = static_cast<std::int32_t>(value);
  return number >= 0 && number <= static_cast<std::int32_t>(last);
}

bool makeSafe(FeedEye& eye) {
  if (!inRange(eye.image, FeedImage::kNoMemory)) return false;
  if (eye.width < 0 || eye.width > kFeedWidth || eye.height < 0 || eye.height > kFeedHeight) return false;
  if (eye.image == FeedImage::kShown &&
      (eye.width == 0 || eye.height == 0 || (eye.channels != 1 && eye.channels != 3)))
    return false;
  if (eye.shaft_points < 0 || eye.shaft_points > kFeedShaft) return false;
  if (!drawable(eye.circle) || eye.circle[2] < 0.0) eye.marker_found = 0;
  if (!drawable(eye.tip) || eye.tip[2] < 0.0) eye.tip_found = 0;
  if (!drawable(eye.ellipse)) eye.ellipse = {};
  const auto end = eye.shaft.begin() + eye.shaft_points;
  const bool good = std::all_of(eye.shaft.begin(), end, [](const auto& point) { return drawable(point); });
  if (!good) eye.shaft_points = 0;
  return true;
}

}  // namespace

void setText(char* to, std::size_t size, std::string_view text) {
  std::size_t length = std::min(text.size(), size - 1);
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80; };
  while (length > 0 && length < text.size() && continues(length)) --length;
  std::memset(to, 0, size);
  std::memcpy(to, text.data(), length);
}

std::size_t imageBytes(const FeedEye& eye) {
  if (eye.image != FeedImage::kShown) return 0;
  return static_cast<std::size_t>(eye.width) * static_cast<std::size_t>(eye.height) *
         static_cast<std::size_t>(eye.channels);
}

bool makeSafe(FeedState& state) {
  if (!inRange(state.tracking, FeedTracking::kNoCamera)) return false;
  cleanText(state.words);
  cleanText(state.title);
  for (auto& name : state.joints) cleanText(name);
  return makeSafe(state.eyes[0]) && makeSafe(state.eyes[1]);
}

}  // namespace capstan::live
