#pragma once

#include <string>

#include "core/base/table.h"
#include "core/diagnosis/report/report.h"

namespace capstan::cli {

/// Text of a report for a terminal, in units for people: the verdict, causes and ties, unexplained residuals,
/// residuals of each model, the refit, the ranking and the errors of the Kalman filter. The text of a
/// cancelled report has no verdict, only the results until then.
std::string textOf(const diagnosis::Report& report);

/// Text of a table for a terminal: columns aligned, numbers to the right; the wrapped note follows.
std::string plainText(const base::Table& table);

/// `text` wrapped to the width of a terminal, with `indent` spaces at the start of each line.
std::string wrapped(const std::string& text, std::size_t indent = 0);

}  // namespace capstan::cli
