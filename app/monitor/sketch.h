#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "app/monitor/colours.h"
#include "app/monitor/font.h"
#include "app/monitor/layout.h"

namespace capstan::monitor {

struct Point {
  float x, y;
};

/// A corner of a triangle: pixels of the window, texel of the atlas, colour.
struct Vertex {
  float x, y, u, v;
  float r, g, b, a;
};

/// Lines, ellipses, rectangles and texts as triangles. Edges of lines fade over one pixel.
class Sketch {
 public:
  void clear() { vertices_.clear(); }
  const std::vector<Vertex>& vertices() const { return vertices_; }

  void fill(const Rect& rect, const Colour& colour);
  /// A line of this width through the points; `dash`: length of its dashes and gaps, 0: none.
  void line(std::span<const Point> points, float width, const Colour& colour, bool closed = false,
            float dash = 0.0F);
  /// The line over a wider dark one, so that it is visible on any image.
  void haloed(std::span<const Point> points, float width, const Colour& colour, bool closed = false,
              float dash = 0.0F);
  void disc(std::span<const Point> border, const Colour& colour);  ///< fills a convex border
  /// Text whose base line begins at `at`. Returns the end of the pen.
  float text(const Font& font, Point at, std::string_view utf8, const Colour& colour);
  /// Text that ends at `at`.
  void textBefore(const Font& font, Point at, std::string_view utf8, const Colour& colour);
  /// Text about the middle `x`.
  void textAbout(const Font& font, Point at, std::string_view utf8, const Colour& colour);

 private:
  void triangle(const Vertex& a, const Vertex& b, const Vertex& c);
  void quad(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d);
  void stroke(std::span<const Point> points, float width, const Colour& colour, bool closed);

  std::vector<Vertex> vertices_;
};

/// Border of an ellipse with half axes `a` and `b`; `angle`: of `a`, from x to y [rad].
std::vector<Point> ellipseBorder(Point centre, float a, float b, float angle);

}  // namespace capstan::monitor
