#include "widgets/scene/tension_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace capstan::widgets {

void TensionScale::include(const Eigen::Vector3d& tension) {
  for (const double value : tension) {
    if (!std::isfinite(value)) continue;
    const double size = std::abs(value);
    if (size <= limit_) continue;
    const double decade = std::pow(10.0, std::floor(std::log10(size)));
    for (const double step : {1.0, 2.0, 5.0, 10.0})
      if (step * decade >= size) {
        limit_ = step * decade;
        break;
      }
  }
}

QColor TensionScale::colour(double tension) const {
  struct Stop {
    double at, r, g, b;
  };
  static constexpr std::array<Stop, 5> kStops = {{{-1.0, 0, 114, 178},
                                                  {-0.4, 86, 160, 220},
                                                  {0.0, 150, 156, 164},
                                                  {0.4, 240, 180, 60},
                                                  {1.0, 235, 80, 0}}};
  if (!std::isfinite(tension)) return {150, 156, 164};
  const double x = std::clamp(tension / limit_, -1.0, 1.0);
  std::size_t i = 1;
  while (i + 1 < kStops.size() && x > kStops[i].at) ++i;
  const Stop &a = kStops[i - 1], &b = kStops[i];
  const double s = (x - a.at) / (b.at - a.at);
  return QColor::fromRgbF((a.r + s * (b.r - a.r)) / 255, (a.g + s * (b.g - a.g)) / 255,
                          (a.b + s * (b.b - a.b)) / 255);
}

}  // namespace capstan::widgets
