#include "core/recording/column_units.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/units.h"

namespace capstan::recording {
namespace {

/// Quantity named `name`, or quantity that has a column `name`; null: none.
const UnitQuantity* quantityOf(std::string_view name) {
  for (const UnitQuantity& quantity : unitQuantities()) {
    if (name == quantity.name) return &quantity;
    if (!quantity.columns || !name.starts_with(quantity.name)) continue;
    const std::string_view digits = name.substr(quantity.name.size());
    if (digits.size() == 1 && digits[0] >= '1' && digits[0] <= '7') return &quantity;
  }
  return nullptr;
}

std::string unitsOf(const UnitQuantity& quantity) {
  std::string names;
  for (const ColumnUnit unit : quantity.units) names += std::string(base::nameOf(unit)) + ", ";
  return names + "keep";
}

std::pair<std::string, ColumnUnit> parsePart(std::string_view part, const std::string& option) {
  const std::size_t equals = part.find('=');
  const std::string name(part.substr(0, equals));
  const UnitQuantity* quantity = quantityOf(name);
  if (!quantity)
    throw base::InputError({{},
                            0,
                            option,
                            std::string(part),
                            "is not a column with a selectable unit",
                            "Give q_m, dq_m, q, p_c, t, or one column of these, as in q_m=deg,q3=mm"});
  const auto unit =
      equals == std::string_view::npos ? std::nullopt : base::fromName<ColumnUnit>(part.substr(equals + 1));
  const auto& units = quantity->units;
  if (!unit || (*unit != ColumnUnit::kSi && std::find(units.begin(), units.end(), *unit) == units.end()))
    throw base::InputError({{},
                            0,
                            option,
                            std::string(part),
                            fmt::format("is not a possible unit of {}", name),
                            fmt::format("Give {}= and one of {}", name, unitsOf(*quantity))});
  return {name, *unit};
}

void checkLength(const std::string& file, const robot::Description& robot, std::size_t joint,
                 const std::string& column, ColumnUnit unit) {
  if (joint >= robot.joints.size() || robot.joints[joint].type == robot::JointType::kPrismatic) return;
  throw base::InputError({file, 0, column, std::string(base::nameOf(unit)),
                          fmt::format("joint {} of {} is revolute", joint + 1, robot.name),
                          fmt::format("Give {}=deg or {}=keep", column, column)});
}

}  // namespace

double factorOf(ColumnUnit unit) {
  switch (unit) {
    case ColumnUnit::kSi:
      return 1.0;
    case ColumnUnit::kDegrees:
      return base::kRadiansPerDegree;
    case ColumnUnit::kCentimetres:
      return 1e-2;
    case ColumnUnit::kMillimetres:
    case ColumnUnit::kMilliseconds:
      return 1e-3;
    case ColumnUnit::kMicroseconds:
      return 1e-6;
    case ColumnUnit::kNanoseconds:
      break;
  }
  return 1e-9;
}

std::string_view wordOf(ColumnUnit unit) {
  switch (unit) {
    case ColumnUnit::kDegrees:
      return "degrees";
    case ColumnUnit::kMillimetres:
      return "millimetres";
    case ColumnUnit::kCentimetres:
      return "centimetres";
    case ColumnUnit::kMilliseconds:
      return "milliseconds";
    case ColumnUnit::kMicroseconds:
      return "microseconds";
    case ColumnUnit::kNanoseconds:
      return "nanoseconds";
    case ColumnUnit::kSi:
      break;
  }
  return "SI";
}

const std::array<UnitQuantity, 5>& unitQuantities() {
  using U = ColumnUnit;
  static const std::array<UnitQuantity, 5> all = {
      UnitQuantity{"t", nullptr, {U::kMilliseconds, U::kMicroseconds, U::kNanoseconds}},
      UnitQuantity{"q_m", &MeasuredTable::q_m, {U::kDegrees}},
      UnitQuantity{"dq_m", &MeasuredTable::dq_m, {U::kDegrees}},
      UnitQuantity{"q", &MeasuredTable::q, {U::kDegrees, U::kMillimetres, U::kCentimetres}},
      UnitQuantity{"p_c", &MeasuredTable::p_c, {U::kMillimetres, U::kCentimetres}}};
  return all;
}

std::optional<ColumnUnit> ReadAs::of(std::string_view quantity, std::string_view column) const {
  auto found = units.find(column);
  if (found == units.end()) found = units.find(quantity);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

ReadAs parseReadAs(std::string_view text, const std::string& option) {
  ReadAs read_as;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const auto [name, unit] = parsePart(text.substr(0, comma), option);
    if (!read_as.units.emplace(name, unit).second)
      throw base::InputError({{}, 0, option, name, "is named twice", "Name it once"});
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
  }
  return read_as;
}

std::string formatReadAs(const ReadAs& read_as) {
  std::string text;
  for (const auto& [name, unit] : read_as.units)
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, base::nameOf(unit));
  return text;
}

ReadAs overlaid(ReadAs earlier, const ReadAs& later) {
  for (const auto& [name, unit] : later.units) earlier.units[name] = unit;
  return earlier;
}

void readColumnsAs(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as) {
  std::map<std::string, bool, std::less<>> met;
  for (const auto& [name, unit] : read_as.units) met[name] = name == "t";
  for (const UnitQuantity& quantity : unitQuantities()) {
    if (!quantity.columns) {
      const double factor = factorOf(read_as.of("t", "t").value_or(ColumnUnit::kSi));
      for (double& t : table.t) t *= factor;
      continue;
    }
    auto& columns = table.*quantity.columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string column = fmt::format("{}{}", quantity.name, i + 1);
      for (const std::string_view name : {std::string_view(column), quantity.name})
        if (const auto named = met.find(name); named != met.end()) named->second = true;
      const ColumnUnit unit = read_as.of(quantity.name, column).value_or(ColumnUnit::kSi);
      if (quantity.columns == &MeasuredTable::q &&
          (unit == ColumnUnit::kMillimetres || unit == ColumnUnit::kCentimetres))
        checkLength(table.file, robot, i, column, unit);
      const double factor = factorOf(unit);
      if (factor == 1.0) continue;
      for (double& value : columns[i]) value *= factor;
    }
  }
  for (const auto& [name, found] : met)
    if (!found)
      throw base::InputError({table.file,
                              1,
                              name,
                              {},
                              "has a unit in --read-as, but is not a column of the table",
                              "Name columns of this table; convert tables with different units one by one"});
}

}  // namespace capstan::recording
