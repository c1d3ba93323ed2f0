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

/// The one declaration of a configuration field, which file, command line, form and session header all use.
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
/// and matrices, std::array, std::vector, std::optional, std::map<std::string, T> and structs that have
/// such a function themselves. A std::vector of structs with `static constexpr bool kMapEntry = true` and two
/// fields, a text and something else, is a map in files, in the order of the list.
struct FieldInfo {
  std::string_view key;
  std::string_view unit;     ///< SI symbol; empty: none
  std::string_view meaning;  ///< one line, shown in forms and written as a comment
  Range range = {};          ///< of every number in the field
  bool required = true;      ///< absent: error; not required and absent: the default stays
  bool sparing = false;      ///< of an enum or a list: not written while it is the first, or empty
};

}  // namespace capstan::base
