#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"

namespace capstan::diagnosis {

using base::Table;

std::vector<RefitNumber> refitInOrder(const Report& report) {
  std::vector<RefitNumber> numbers = report.refit;
  std::ranges::stable_sort(numbers, std::greater<>(),
                           [](const RefitNumber& one) { return std::pair(one.material, one.moved); });
  return numbers;
}

std::string refitChange(const RefitNumber& one) {
  const double change = one.value - one.nominal;
  if (std::abs(change) <= std::abs(one.nominal))
    return base::withMinus(fmt::format("{:+.1f} %", change == 0.0 ? 0.0 : 100.0 * change / one.nominal));
  return (change > 0.0 ? "+" : "") + shownNumber(change, 0.0, one.unit);
}

std::string refitRemark(const RefitNumber& one, const Tolerance& tolerance) {
  std::string text = one.material ? "material" : one.moved ? "moved" : "not moved";
  std::size_t joint = 0;
  double most = 0.0;  // in tolerances
  for (std::size_t j = 0; j < one.moves.joints.size(); ++j) {
    const Displacement& moved = one.moves.joints[j];
    const double share = moved.rms / (moved.slides ? tolerance.length : tolerance.angle);
    if (share > most) most = share, joint = j + 1;
  }
  if (joint > 0) {
    const Displacement& moved = one.moves.joints[joint - 1];
    text += fmt::format(": {} at joint {}", shownNumber(moved.rms, 0.0, moved.slides ? "m" : "rad"), joint);
  }
  return one.at_bound ? text + "; at its bound: it would go further" : text;
}

Table refitTable(const Report& report) {
  const bool effects = hasEffects(report);
  Table table;
  table.title = "Parameters of the nominal model after the refit";
  table.columns = {textColumn("number"),          textColumn("nominal"),
                   textColumn("without effects"), textColumn(effects ? "with effects" : "refitted"),
                   textColumn("change"),          textColumn("remark")};
  for (const RefitNumber& one : refitInOrder(report))
    table.rows.push_back({shownName(one.name), shownNumber(one.nominal, 0.0, one.unit),
                          shownNumber(one.value_without, 0.0, one.unit),
                          shownNumber(one.value, one.sigma, one.unit), refitChange(one),
                          refitRemark(one, report.material)});
  table.note =
      "Moved: by more than two standard deviations; material: the change of this number alone also moves a "
      "joint "
      "by more than the tolerance (RMS displacement in the remark). A mistuned parameter is not a missing "
      "effect.";
  if (effects) return table;
  constexpr std::ptrdiff_t kWithout = 2;  // without effects the two values are the same
  table.columns.erase(table.columns.begin() + kWithout);
  for (auto& row : table.rows) row.erase(row.begin() + kWithout);
  return table;
}

}  // namespace capstan::diagnosis
