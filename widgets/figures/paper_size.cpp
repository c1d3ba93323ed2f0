#include "widgets/figures/paper_size.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/error.h"

namespace capstan::widgets {

namespace {

constexpr double kMillimetresPerInch = 25.4;

std::optional<double> sideOf(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(std::string_view text, std::string_view option, std::string reason) {
  throw base::InputError({{},
                          0,
                          std::string(option),
                          std::string(text),
                          std::move(reason),
                          "Give width and height in millimetres, as 180x120"});
}

}  // namespace

QSize PaperSize::dots() const {
  const auto dots = [](double mm) {
    return static_cast<int>(std::lround(mm / kMillimetresPerInch * kDotsPerInch));
  };
  return {dots(width_mm), dots(height_mm)};
}

PaperSize parsePaperSize(std::string_view text, std::string_view option) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) refuse(text, option, "is no size");
  const auto width = sideOf(text.substr(0, cross)), height = sideOf(text.substr(cross + 1));
  if (!width || !height) refuse(text, option, "is no size");
  for (const double side : {*width, *height})
    if (side < PaperSize::kLeast || side > PaperSize::kMost)
      refuse(text, option,
             fmt::format("{} mm is not within {} to {} mm", side, PaperSize::kLeast, PaperSize::kMost));
  return {*width, *height};
}

}  // namespace capstan::widgets
