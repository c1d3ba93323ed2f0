#include "core/recording/settle_units.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/recording/motor_speeds.h"

namespace capstan::recording {
namespace {

std::size_t columnsOf(const MeasuredTable& table, std::string_view name) {
  for (const UnitQuantity& quantity : unitQuantities())
    if (quantity.name == name) return quantity.columns ? (table.*quantity.columns).size() : 1;
  return 0;
}

std::string linesOf(const std::vector<UnitFinding>& findings) {
  std::string text;
  for (const UnitFinding& found : findings) text += fmt::format("\n  {} {}", found.column, found.text);
  return text;
}

std::string keepAll(const std::vector<UnitFinding>& findings) {
  std::string text;
  for (std::size_t i = 0; i < findings.size(); ++i)
    if (i == 0 || findings[i].quantity != findings[i - 1].quantity)
      text += fmt::format("{}{}=keep", text.empty() ? "" : ",", findings[i].quantity);
  return text;
}

/// A unit in which the values are plausible need not be theirs.
std::string remedyFor(const MeasuredTable& table, const std::vector<UnitFinding>& findings) {
  const std::string proposed = proposedReadAs(table, findings), keep = keepAll(findings);
  const std::string convert =
      proposed == keep
          ? ""
          : fmt::format("If these are their units, read it with --read-as {0} (live set-up: read_as: {0}). ",
                        proposed);
  return fmt::format(
      "\n{}If the values are right as they are, read it with --read-as {}. A table of another robot needs "
      "its robot file",
      convert, keep);
}

bool anyImplausible(const std::vector<UnitFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const UnitFinding& f) { return f.implausible; });
}

/// Throws base::InputError if columns are implausible with `read_as`: columns with a stated unit, and columns
/// that were plausible `before`.
void refuseStated(const MeasuredTable& table, const ReadAs& read_as, const std::vector<UnitFinding>& before,
                  std::vector<UnitFinding> after) {
  std::erase_if(after, [&](const UnitFinding& found) {
    const bool stated = read_as.of(found.quantity, found.column).has_value();
    const bool was = std::any_of(before.begin(), before.end(), [&](const UnitFinding& earlier) {
      return earlier.implausible && earlier.column == found.column;
    });
    return !found.implausible || (was && !stated);
  });
  if (after.empty()) return;
  throw base::InputError(
      {table.file, 0, "--read-as", formatReadAs(read_as),
       "does not fit the table. With these units:" + linesOf(after),
       fmt::format("\nState only units that the table has, and those of all columns that are not "
                   "in SI; {} leaves these columns unconverted",
                   keepAll(after))});
}

}  // namespace

std::string proposedReadAs(const MeasuredTable& table, const std::vector<UnitFinding>& findings) {
  std::string text;
  const auto add = [&](const std::string& name, std::optional<ColumnUnit> unit) {
    text +=
        fmt::format("{}{}={}", text.empty() ? "" : ",", name, base::nameOf(unit.value_or(ColumnUnit::kSi)));
  };
  for (auto begin = findings.begin(); begin != findings.end();) {
    const auto end = std::find_if(
        begin, findings.end(), [&](const UnitFinding& other) { return other.quantity != begin->quantity; });
    const bool alike =
        static_cast<std::size_t>(end - begin) == columnsOf(table, begin->quantity) &&
        std::all_of(begin, end, [&](const UnitFinding& other) { return other.unit == begin->unit; });
    if (alike)
      add(begin->quantity, begin->unit);
    else
      for (auto found = begin; found != end; ++found) add(found->column, found->unit);
    begin = end;
  }
  return text;
}

ImplausibleUnits::ImplausibleUnits(const MeasuredTable& table, std::vector<UnitFinding> findings)
    : InputError(
          {table.file,
           0,
           {},
           {},
           "columns that are implausible for this robot in SI units. Nothing was read:" + linesOf(findings),
           remedyFor(table, findings)}),
      findings_(std::move(findings)) {}

void settleUnits(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as) {
  std::vector<UnitFinding> before;
  if (!read_as.empty()) before = implausibleUnits(table, robot);
  readColumnsAs(table, robot, read_as);
  checkTimeRange(table);
  std::vector<UnitFinding> findings = implausibleUnits(table, robot);
  std::erase_if(findings, [&](const UnitFinding& found) {
    return read_as.of(found.quantity, found.column) == ColumnUnit::kSi;
  });
  if (!read_as.empty()) refuseStated(table, read_as, before, findings);
  std::erase_if(findings, [&](const UnitFinding& found) {
    return read_as.of(found.quantity, found.column).has_value();
  });
  if (anyImplausible(findings)) throw ImplausibleUnits(table, std::move(findings));
}

std::vector<std::string> unitNotices(const MeasuredTable& table) {
  const double period = medianPeriod(table);
  if (!(period < 1e-4)) return {};
  return {fmt::format("sample period {:.4g} s: is t not in seconds?", period)};
}

}  // namespace capstan::recording
