#pragma once

#include <optional>
#include <string>

#include "core/base/table.h"

/// What pages of this program are made of: they open without a network, have no scripts and nothing from
/// elsewhere, and are light or dark as the reader's screen is. UTF-8.
namespace capstan::widgets {

/// From the doctype to the begin of the body, with `mark` in its head. `style`: rules besides the common
/// ones.
std::string htmlHead(const std::string& title, const std::string& mark, const std::string& style = {});
std::string htmlEscaped(const std::string& text);
/// A file name as part of an address: everything but letters, digits, - . _ as %XX.
std::string htmlAddress(const std::string& name);
/// Heading, table and note. `bars`: a column of per cent that bars are drawn behind.
std::string htmlTable(const base::Table& table, std::optional<std::size_t> bars = {});

}  // namespace capstan::widgets
