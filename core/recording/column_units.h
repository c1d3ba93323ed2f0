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

/// The unit of a table's column, where it is not the SI unit of measured-table.md.
enum class ColumnUnit {
  kSi,            ///< as it stands
  kDegrees,       ///< of q_m, dq_m (per second) and q; of a sliding joint m · 180/π, as RAVEN-II's software
                  ///< publishes the insertion axis
  kMillimetres,   ///< of p_c, and of q of a sliding joint
  kCentimetres,   ///< as millimetres
  kMilliseconds,  ///< of t
  kMicroseconds,
  kNanoseconds,
};

/// SI by one unit.
double factorOf(ColumnUnit unit);
/// "millimetres"
std::string_view wordOf(ColumnUnit unit);

/// What a person said of the units of a table: by quantity (q_m: all of its columns) or by column (q_m1),
/// which goes before its quantity.
struct ReadAs {
  std::map<std::string, ColumnUnit, std::less<>> units;

  bool empty() const { return units.empty(); }
  /// What was said of `column` of `quantity`; none: nothing.
  std::optional<ColumnUnit> of(std::string_view quantity, std::string_view column) const;
  bool operator==(const ReadAs&) const = default;
};

/// From "q_m=deg,p_c=mm,t=ms,q3=keep"; empty text: nothing was said. Throws base::InputError with `option`
/// for a name that is no column or quantity with a unit to choose, and for a unit that it cannot have.
ReadAs parseReadAs(std::string_view text, const std::string& option);
std::string formatReadAs(const ReadAs& read_as);

/// `earlier`, with what `later` says of the same names in place of it.
ReadAs overlaid(ReadAs earlier, const ReadAs& later);

/// A quantity of the table whose unit can be mistaken.
struct UnitQuantity {
  std::string_view name;
  TableColumns MeasuredTable::*columns;  ///< null: t
  std::vector<ColumnUnit> units;         ///< that it may be in, besides SI
};
const std::array<UnitQuantity, 5>& unitQuantities();

/// Multiplies the columns of `table` by factorOf() what was said of them. Throws base::InputError where a
/// column was named that the table lacks, or millimetres of a joint of `robot` that turns.
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
