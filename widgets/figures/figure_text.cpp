#include "widgets/figures/figure_text.h"

#include <fmt/format.h>

#include "core/base/table.h"

namespace capstan::widgets {

std::string csvText(const QString& text) { return base::csvQuoted(text.toStdString()); }

std::string csvNumber(double value) { return std::isnan(value) ? std::string() : fmt::format("{}", value); }

}  // namespace capstan::widgets
