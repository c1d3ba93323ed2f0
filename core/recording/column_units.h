#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/names.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// Unit of a table's column, if it differs from the SI unit in measured-table.md.
enum class ColumnUnit {
  kSi,       ///< SI: values as they are
  kDegrees,  ///< for q_m, dq_m (per second) and q; for a sliding joint m · 180/π, as RAVEN-II's software
             ///< publishes the insertion axis
  kMillimetres,   ///< for p_c, and for q of a sliding joint
  kCentimetres,   ///< for the same columns as kMillimetres
  kMilliseconds,  ///< for t
  kMicroseconds,
  kNanoseconds,
};

/// Factor from `unit` to SI.
double factorOf(ColumnUnit unit);
/// Name of the unit, e.g. "millimetres".
std::string_view wordOf(ColumnUnit unit);

/// Units of a table as stated by the user: by quantity (q_m: all of its columns) or by column (q_m1). A
/// column takes precedence over its quantity.
struct ReadAs {
  std::map<std::string, ColumnUnit, std::less<>> units;

  bool empty() const { return units.empty(); }
  /// Stated unit of `column` of `quantity`; nothing if none was stated.
  std::optional<ColumnUnit> of(std::string_view quantity, std::string_view column) const;
  bool operator==(const ReadAs&) const = default;
};

/// Parses "q_m=deg,p_c=mm,t=ms,q3=keep"; empty text: no units stated. Throws base::InputError with `option`
/// for a name that is not a column or quantity with selectable units, and for a unit that it cannot have.
ReadAs parseReadAs(std::string_view text, const std::string& option);
std::string formatReadAs(const ReadAs& read_as);

/// Merges two statements; `later` replaces the units of the same names in `earlier`.
ReadAs overlaid(ReadAs earlier, const ReadAs& later);

/// A quantity of the table whose unit can be confused.
struct UnitQuantity {
  std::string_view name;
  TableColumns MeasuredTable::*columns;  ///< null: t
  std::vector<ColumnUnit> units;         ///< possible units besides SI
};
const std::array<UnitQuantity, 5>& unitQuantities();

/// Multiplies each column of `table` by factorOf() its stated unit. Throws base::InputError for a named
/// column that the table lacks, and for millimetres stated for a revolute joint of `robot`.
void readColumnsAs(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as);

}  // namespace capstan::recording

template <>
struct capstan::base::NamesOf<capstan::recording::ColumnUnit> {
  using U = capstan::recording::ColumnUnit;
  static constexpr std::array value = {std::pair{U::kSi, "keep"},         std::pair{U::kDegrees, "deg"},
                                       std::pair{U::kMillimetres, "mm"},  std::pair{U::kCentimetres, "cm"},
                                       std::pair{U::kMilliseconds, "ms"}, std::pair{U::kMicroseconds, "us"},
                                       std::pair{U::kNanoseconds, "ns"}};
};
