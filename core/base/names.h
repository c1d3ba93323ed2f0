#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace capstan::base {

/// Specialise for an enum so that files and screens can spell its values:
///     template <> struct NamesOf<JointType> {
///       static constexpr std::array value = {std::pair{JointType::kRevolute, "revolute"}, …};
///     };
template <class Enum>
struct NamesOf;

template <class Enum>
concept Named = requires {
  NamesOf<Enum>::value.size();
};

template <Named Enum>
constexpr std::string_view nameOf(Enum which) {
  for (const auto& [value, name] : NamesOf<Enum>::value)
    if (value == which) return name;
  return "unknown";
}

template <Named Enum>
constexpr std::optional<Enum> fromName(std::string_view text) {
  for (const auto& [value, name] : NamesOf<Enum>::value)
    if (name == text) return value;
  return std::nullopt;
}

}  // namespace capstan::base
