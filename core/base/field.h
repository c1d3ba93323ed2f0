#pragma once

#include <limits>
#include <string_view>

namespace capstan::base {

/// Closed interval of allowed values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  constexpr bool contains(double value) const { return value >= min && value <= max; }
};

inline constexpr Range kPositive{std::numeric_limits<double>::min(), std::numeric_limits<double>::infinity()};
inline constexpr Range kNotNegative{0.0, std::numeric_limits<double>::infinity()};

/// Declaration of a configuration field. File, command line, form and session header all use this
/// declaration.
///
/// A configurable struct declares its fields once, in file order:
///
///     struct Cable {
///       double stiffness = 720e3;
///       template <class Self, class Visitor>
///       static void visit(Self& self, Visitor&& field) {
///         field(self.stiffness, {"stiffness", "N", "cable stiffness k_e, UKF paper (5)", {1.0, 1e8}});
///       }
///     };
///
/// Field types: bool, int, double, std::string, enums with a NamesOf specialisation, fixed-size Eigen vectors
/// and matrices, std::array, std::vector, std::optional, std::map<std::string, T> and structs that have their
/// own visit(). A std::vector of structs with `static constexpr bool kMapEntry = true` is written to files as
/// a map in the order of the vector; the struct has two fields, a text (the key) and the value.
struct FieldInfo {
  std::string_view key;
  std::string_view unit;     ///< SI symbol; empty: none
  std::string_view meaning;  ///< one line, shown in forms and written as a comment
  Range range = {};          ///< allowed range of every number in the field
  bool required = true;      ///< whether a missing field is an error; otherwise it keeps its default
  bool sparing = false;      ///< whether an enum at its first value, or an empty list, is not written
};

}  // namespace capstan::base
