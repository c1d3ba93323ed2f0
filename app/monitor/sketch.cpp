#include "app/monitor/sketch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::monitor {

namespace {

constexpr float kFull = 1.5F;  // middle of the atlas's full texels

Vertex solid(Point at, const Colour& c, float alpha) {
  return {at.x, at.y, kFull, kFull, c.r, c.g, c.b, alpha};
}

Point along(Point a, Point b, float share) { return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; }
float distance(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Unit normal of the line at point `i`: the mean of its two sides.
Point normalAt(std::span<const Point> points, std::size_t i, bool closed) {
  const std::size_t n = points.size();
  const Point before = i > 0 ? points[i - 1] : closed ? points[n - 1] : points[i];
  const Point after = i + 1 < n ? points[i + 1] : closed ? points[0] : points[i];
  const float length = std::max(distance(before, after), 1e-6F);
  return {-(after.y - before.y) / length, (after.x - before.x) / length};
}

/// Pieces of a line that are drawn when it is dashed.
std::vector<std::vector<Point>> dashes(std::span<const Point> points, float dash) {
  std::vector<std::vector<Point>> pieces;
  float left = dash;
  bool drawn = true;
  if (!points.empty()) pieces.push_back({points[0]});
  for (std::size_t i = 1; i < points.size(); ++i) {
    Point from = points[i - 1];
    float rest = distance(from, points[i]);
    while (rest > left) {
      from = along(from, points[i], left / rest);
      rest -= left;
      left = dash;
      if (drawn)
        pieces.back().push_back(from);
      else
        pieces.push_back({from});
      drawn = !drawn;
    }
    left -= rest;
    if (drawn) pieces.back().push_back(points[i]);
  }
  return pieces;
}

}  // namespace

void Sketch::triangle(const Vertex& a, const Vertex& b, const Vertex& c) {
  vertices_.insert(vertices_.end(), {a, b, c});
}

void Sketch::quad(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void Sketch::fill(const Rect& rect, const Colour& colour) {
  const auto x = static_cast<float>(rect.x), y = static_cast<float>(rect.y);
  const auto right = static_cast<float>(rect.x + rect.width),
             bottom = static_cast<float>(rect.y + rect.height);
  quad(solid({x, y}, colour, colour.a), solid({right, y}, colour, colour.a),
       solid({right, bottom}, colour, colour.a), solid({x, bottom}, colour, colour.a));
}

void Sketch::stroke(std::span<const Point> points, float width, const Colour& colour, bool closed) {
  const std::size_t n = points.size();
  if (n < 2) return;
  const std::array<float, 4> offsets = {-0.5F * width - 0.5F, -0.5F * width + 0.5F, 0.5F * width - 0.5F,
                                        0.5F * width + 0.5F};
  const std::array<float, 4> alphas = {0.0F, colour.a, colour.a, 0.0F};
  const auto corner = [&](std::size_t i, std::size_t k) {
    const Point normal = normalAt(points, i, closed);
    return solid({points[i].x + offsets[k] * normal.x, points[i].y + offsets[k] * normal.y}, colour,
                 alphas[k]);
  };
  for (std::size_t i = 0; i + 1 < n + (closed ? 1 : 0); ++i) {
    const std::size_t next = (i + 1) % n;
    for (std::size_t k = 0; k < 3; ++k)
      quad(corner(i, k), corner(next, k), corner(next, k + 1), corner(i, k + 1));
  }
}

void Sketch::line(std::span<const Point> points, float width, const Colour& colour, bool closed, float dash) {
  if (dash <= 0.0F) return stroke(points, width, colour, closed);
  std::vector<Point> open(points.begin(), points.end());
  if (closed && !open.empty()) open.push_back(open.front());
  for (const auto& piece : dashes(open, dash)) stroke(piece, width, colour, false);
}

void Sketch::haloed(std::span<const Point> points, float width, const Colour& colour, bool closed,
                    float dash) {
  line(points, 1.8F * width + 1.0F, kBlack.faded(0.6F), closed);
  line(points, width, colour, closed, dash);
}

void Sketch::disc(std::span<const Point> border, const Colour& colour) {
  for (std::size_t i = 2; i < border.size(); ++i)
    triangle(solid(border[0], colour, colour.a), solid(border[i - 1], colour, colour.a),
             solid(border[i], colour, colour.a));
}

float Sketch::text(const Font& font, Point at, std::string_view utf8, const Colour& c) {
  float pen = at.x;
  while (!utf8.empty()) {
    const Glyph& glyph = font.glyph(takeCharacter(utf8));
    const float x = std::round(pen) + static_cast<float>(glyph.left);
    const float y = std::round(at.y) - static_cast<float>(glyph.top);
    const auto w = static_cast<float>(glyph.width), h = static_cast<float>(glyph.height);
    const auto u = static_cast<float>(glyph.x), v = static_cast<float>(glyph.y);
    if (glyph.width > 0)
      quad({x, y, u, v, c.r, c.g, c.b, c.a}, {x + w, y, u + w, v, c.r, c.g, c.b, c.a},
           {x + w, y + h, u + w, v + h, c.r, c.g, c.b, c.a}, {x, y + h, u, v + h, c.r, c.g, c.b, c.a});
    pen += glyph.advance;
  }
  return pen;
}

void Sketch::textBefore(const Font& font, Point at, std::string_view utf8, const Colour& colour) {
  text(font, {at.x - font.width(utf8), at.y}, utf8, colour);
}

void Sketch::textAbout(const Font& font, Point at, std::string_view utf8, const Colour& colour) {
  text(font, {at.x - 0.5F * font.width(utf8), at.y}, utf8, colour);
}

std::vector<Point> ellipseBorder(Point centre, float a, float b, float angle) {
  const int corners = std::clamp(static_cast<int>(std::max(a, b)), 24, 96);
  const float cos = std::cos(angle), sin = std::sin(angle);
  std::vector<Point> border;
  for (int i = 0; i < corners; ++i) {
    const float at = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(corners);
    const float x = a * std::cos(at), y = b * std::sin(at);
    border.push_back({centre.x + cos * x - sin * y, centre.y + sin * x + cos * y});
  }
  return border;
}

}  // namespace capstan::monitor
