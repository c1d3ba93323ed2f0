#pragma once

#include <optional>
#include <string>

#include "core/base/table.h"

/// Parts of the HTML pages that Capstan writes. Pages need no network, have no scripts or external files, and
/// follow the reader's light or dark scheme. UTF-8.
namespace capstan::widgets {

/// HTML from the doctype to the start of the body, with `mark` in its head. `style`: CSS rules added to the
/// common ones.
std::string htmlHead(const std::string& title, const std::string& mark, const std::string& style = {});
std::string htmlEscaped(const std::string& text);
/// A file name as part of a URL: all but letters, digits, - . _ as %XX.
std::string htmlAddress(const std::string& name);
/// Heading, table and note as HTML. `bars`: column of percentages behind which bars are drawn.
std::string htmlTable(const base::Table& table, std::optional<std::size_t> bars = {});

}  // namespace capstan::widgets
