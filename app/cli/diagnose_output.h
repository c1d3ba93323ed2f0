#pragma once

#include <string>

#include "core/base/table.h"
#include "core/diagnosis/report/report.h"

namespace capstan::cli {

/// A report for a terminal: the verdict first, then causes and ties in words and units for people, what each
/// model gets wrong, the refit, the ranking, what stays unexplained and what the filter gains. One that was
/// cancelled has no verdict, only what was known until then.
std::string textOf(const diagnosis::Report& report);

/// A table for a terminal: columns aligned, those of numbers to the right; its note below, wrapped.
std::string plainText(const base::Table& table);

/// `text` wrapped so that no line is wider than a terminal, each line behind `indent` spaces.
std::string wrapped(const std::string& text, std::size_t indent = 0);

}  // namespace capstan::cli
