#pragma once

#include <set>
#include <string>

namespace capstan::architecture {

/// Functions that a source defines with external linkage, with their class where they have one:
/// "Chain::step", "chainOf". Read from the text as clang-format lays it out: a definition in a namespace
/// begins its line.
std::set<std::string> functionsDefined(const std::string& text);

}  // namespace capstan::architecture
