#include "widgets/figures/figure_text.h"

#include <fmt/format.h>

namespace capstan::widgets {

std::string csvText(const QString& text) {
  if (!text.contains(QLatin1Char(',')) && !text.contains(QLatin1Char('"')) &&
      !text.contains(QLatin1Char('\n')))
    return text.toStdString();
  QString quoted = text;
  quoted.replace(QLatin1String("\""), QLatin1String("\"\""));
  return "\"" + quoted.toStdString() + "\"";
}

std::string csvNumber(double value) { return std::isnan(value) ? std::string() : fmt::format("{}", value); }

}  // namespace capstan::widgets
