#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>

namespace capstan {

/// Refuses what CLI11 reads without a word: nan and inf where a number is expected, and a sign before or
/// more digits than fit a whole number without one. What is no number at all is left to CLI11.
inline void checkNumbers(CLI::App& app) {
  const auto isNumber = [](const std::string& text) {
    char* end = nullptr;
    std::strtod(text.c_str(), &end);
    return end != text.c_str() && *end == '\0';
  };
  const CLI::Validator finite(
      [isNumber](std::string& text) {
        return !isNumber(text) || std::isfinite(std::strtod(text.c_str(), nullptr))
                   ? std::string()
                   : text + " is not a finite number";
      },
      "", "finite");
  const CLI::Validator whole(
      [isNumber](std::string& text) {
        constexpr std::size_t kDigits = 19;  // all below 2^64
        const bool digits =
            std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
        return !isNumber(text) || (digits && text.size() <= kDigits)
                   ? std::string()
                   : text + " is not a whole number from 0 to 9999999999999999999";
      },
      "", "whole");
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("FLOAT")) option->check(finite);
    if (type.starts_with("UINT")) option->check(whole);
  }
  for (CLI::App* command : app.get_subcommands({})) checkNumbers(*command);
}

}  // namespace capstan
