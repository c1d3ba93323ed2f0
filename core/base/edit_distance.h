#pragma once

#include <cstddef>
#include <string_view>

namespace capstan::base {

/// Levenshtein distance: the smallest number of characters to insert, remove or replace that makes `b` of
/// `a`.
std::size_t editDistance(std::string_view a, std::string_view b);

}  // namespace capstan::base
