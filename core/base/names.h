#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace capstan::base {

/// Names of an enum's values in files and on screens. Specialise it for each enum that has such names:
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

/// Stable identifiers of an enum's values in JSON: [a-z0-9_], never changed. Specialise it like NamesOf for
/// an enum whose names in NamesOf are written for people.
template <class Enum>
struct KeysOf;

template <class Enum>
concept Keyed = requires {
  KeysOf<Enum>::value.size();
};

/// Key of `which` from KeysOf; its name from NamesOf when the enum has no KeysOf.
template <Named Enum>
constexpr std::string_view keyOf(Enum which) {
  if constexpr (Keyed<Enum>) {
    for (const auto& [value, key] : KeysOf<Enum>::value)
      if (value == which) return key;
  }
  return nameOf(which);
}

}  // namespace capstan::base
