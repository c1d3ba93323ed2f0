#include "core/recording/measured_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "core/base/edit_distance.h"
#include "core/base/error.h"
#include "core/table_files/read_columns.h"
#include "core/table_files/write_columns.h"

namespace capstan::recording {
namespace {

constexpr int kMaxJoints = 7;

using table_files::NamedColumn;

/// One quantity of the table: its columns are prefix1 … prefixn. `linear_unit` holds for sliding joints.
struct Quantity {
  std::string_view prefix;
  TableColumns MeasuredTable::*columns;
  bool by_joint;
  std::string_view unit, linear_unit, meaning;
};

constexpr std::array kQuantities = {
    Quantity{"q_m", &MeasuredTable::q_m, true, "rad", "rad", "position from the hard stop of motor"},
    Quantity{"dq_m", &MeasuredTable::dq_m, true, "rad/s", "rad/s", "velocity of motor"},
    Quantity{"tau_m", &MeasuredTable::tau_m, true, "N*m", "N*m", "torque command of motor"},
    Quantity{"q", &MeasuredTable::q, true, "rad", "m", "encoder, the reference, of joint"},
    Quantity{"p_c", &MeasuredTable::p_c, false, "m", "m", "tip position from the cameras, frame 0, axis"},
    Quantity{"tau_ext", &MeasuredTable::tau_ext, true, "N*m", "N", "measured external load of joint"},
};

std::string columnName(const Quantity& quantity, std::size_t index) {
  return fmt::format("{}{}", quantity.prefix, index + 1);
}

/// Quantity and 0-based index of the column `name`; null: none.
const Quantity* quantityOf(std::string_view name, std::size_t& index) {
  for (const Quantity& quantity : kQuantities) {
    if (!name.starts_with(quantity.prefix)) continue;
    const std::string_view digits = name.substr(quantity.prefix.size());
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (fault != std::errc() || end != digits.data() + digits.size() || digits.front() == '0') continue;
    --index;
    return &quantity;
  }
  return nullptr;
}

/// Letters and digits of a column's name, in lower case: what a person reads of it.
std::string lettersOf(std::string_view name) {
  std::string letters;
  for (const unsigned char c : name)
    if (std::isalnum(c) != 0) letters += static_cast<char>(std::tolower(c));
  return letters;
}

/// Whether the name of an unused column is probably a misspelled `meant`.
bool isMisspelled(std::string_view unused, std::string_view meant) {
  constexpr std::size_t kLongest = 24;  // of a name that is examined
  if (unused.size() > kLongest) return false;
  const std::string letters = lettersOf(unused), of_meant = lettersOf(meant);
  if (meant == "t")
    return letters == "t" || letters.find("time") != std::string::npos ||
           letters.find("stamp") != std::string::npos;
  if (letters.empty() || letters.back() != of_meant.back()) return false;  // the number of the joint
  return base::editDistance(letters, of_meant) <= (of_meant.size() - 1) / 2;
}

/// Columns by (quantity, index) while they are being found, in any order.
class ColumnCollector {
 public:
  explicit ColumnCollector(MeasuredTable& table) : table_(table) {
    for (auto& columns : found_) columns.resize(kMaxJoints);
  }

  std::vector<double>* operator()(std::string_view name) {
    if (!name.empty() && !seen_.emplace(name).second)
      throw base::InputError(
          {table_.file, 1, std::string(name), {}, "is in the header twice", "Rename or remove one"});
    if (name == "t") return &table_.t;
    std::size_t index = 0;
    const Quantity* quantity = quantityOf(name, index);
    if (!quantity) {
      table_.ignored.emplace_back(name);
      return nullptr;
    }
    const std::size_t most = quantity->by_joint ? kMaxJoints : 3;
    if (index >= most)
      throw base::InputError({table_.file,
                              table_.lines.header(),
                              std::string(name),
                              {},
                              fmt::format("has a number above {}, the largest in a table", most),
                              "Rename the column or remove it"});
    auto& column = found_[static_cast<std::size_t>(quantity - kQuantities.data())][index];
    column.present = true;
    return &column.values;
  }

  void finish() {
    if (!seen_.contains("t"))
      refuseMissing(table_, "t", "is not among the columns",
                    "Add the column t: time [s], strictly increasing. Tables of tip poses are read by "
                    "diagnose and learn");
    std::size_t joints = 0;
    for (std::size_t i = 0; i < kQuantities.size(); ++i)
      if (kQuantities[i].by_joint) joints = std::max(joints, lastPresent(found_[i]));
    for (std::size_t i = 0; i < kQuantities.size(); ++i) {
      const std::size_t have = lastPresent(found_[i]);
      if (have == 0) continue;
      const std::size_t want = kQuantities[i].by_joint ? joints : 3;
      for (std::size_t k = 0; k < want; ++k) {
        if (!found_[i][k].present)
          refuseMissing(
              table_, columnName(kQuantities[i], k), reasonOf(i, have, want),
              have == want
                  ? fmt::format("Add it, or correct the number in {}", columnName(kQuantities[i], have - 1))
                  : fmt::format("Add it, or remove the columns of {}", kQuantities[i].prefix));
        (table_.*kQuantities[i].columns).push_back(std::move(found_[i][k].values));
      }
    }
  }

 private:
  struct Found {
    bool present = false;
    std::vector<double> values;
  };
  /// Why the columns of quantity `i`, of which the last is number `have`, are not complete.
  static std::string reasonOf(std::size_t i, std::size_t have, std::size_t want) {
    const Quantity& quantity = kQuantities[i];
    if (have == want) return fmt::format("is missing, yet the table has {}", columnName(quantity, have - 1));
    return fmt::format("is missing, yet other columns are numbered up to {}", want);
  }
  static std::size_t lastPresent(const std::vector<Found>& columns) {
    std::size_t last = 0;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].present) last = k + 1;
    return last;
  }

  MeasuredTable& table_;
  std::array<std::vector<Found>, kQuantities.size()> found_;
  std::set<std::string, std::less<>> seen_;
};

void checkTimeGiven(const MeasuredTable& table) {
  for (std::size_t row = 0; row < table.t.size(); ++row)
    if (std::isnan(table.t[row]))
      throw base::InputError(
          table.lines.at(table.file, row, "t", {}, "is empty", "Give every row its time [s]"));
}

/// Parses the columns without the order of times.
MeasuredTable parseRows(const table_files::ColumnReader& columns, const std::string& file) {
  MeasuredTable table;
  table.file = file;
  table.lines = columns.lines;
  ColumnCollector collector(table);
  columns.read([&](std::string_view name, std::size_t) { return collector(name); });
  collector.finish();
  checkTimeGiven(table);
  return table;
}

}  // namespace

int MeasuredTable::joints() const {
  std::size_t most = 0;
  for (const Quantity& quantity : kQuantities)
    if (quantity.by_joint) most = std::max(most, (this->*quantity.columns).size());
  return static_cast<int>(most);
}

void refuseMisspelled(const MeasuredTable& table, const std::string& name) {
  for (const std::string& unused : table.ignored)
    if (isMisspelled(unused, name))
      throw base::InputError({table.file,
                              table.lines.header(),
                              unused,
                              {},
                              fmt::format("is no column of a measured table; {} is missing", name),
                              fmt::format("Rename it to {}, if that is what it holds", name)});
}

void refuseMissing(const MeasuredTable& table, const std::string& name, const std::string& reason,
                   const std::string& remedy) {
  refuseMisspelled(table, name);
  const std::string unused =
      table.ignored.empty() ? "" : fmt::format("; not used are {}", fmt::join(table.ignored, ", "));
  throw base::InputError({table.file, table.lines.header(), name, {}, reason + unused, remedy});
}

std::string columnMeantBy(const MeasuredTable& table, std::string_view name) {
  for (const Quantity& quantity : kQuantities) {
    const int most = quantity.by_joint ? std::min(table.joints() + 1, kMaxJoints) : 3;
    for (auto k = (table.*quantity.columns).size(); k < static_cast<std::size_t>(most); ++k)
      if (const std::string meant = columnName(quantity, k); isMisspelled(name, meant)) return meant;
  }
  return {};
}

MeasuredTable readMeasuredTable(const table_files::ColumnReader& columns, const std::string& file) {
  MeasuredTable table = parseRows(columns, file);
  checkTimes(table, -std::numeric_limits<double>::infinity());
  return table;
}

MeasuredTable readMeasuredTable(const std::filesystem::path& path) {
  return readMeasuredTable(table_files::columnsIn(path), path.string());
}

MeasuredTable parseMeasuredTable(std::string_view text, const std::string& file) {
  return readMeasuredTable(table_files::columnsOfCsv(text, file), file);
}

void checkTimes(const MeasuredTable& table, double before) {
  for (std::size_t row = 0; row < table.t.size(); before = table.t[row++])
    if (table.t[row] <= before)
      throw base::InputError(
          table.lines.at(table.file, row, "t", fmt::format("{}", table.t[row]),
                         fmt::format("does not come after {} {}", before,
                                     table.lines.first == 0 ? "in the row before" : "on the line before"),
                         "Sort the rows by time and remove repeated ones"));
}

void checkTimeRange(const MeasuredTable& table) {
  for (std::size_t row = 0; row < table.t.size(); ++row)
    if (!(std::abs(table.t[row]) <= kLongestTime))
      throw base::InputError(
          table.lines.at(table.file, row, "t", fmt::format("{}", table.t[row]),
                         fmt::format("is beyond {:g} s", kLongestTime),
                         "Give the time in seconds, or state its unit with --read-as t=ms"));
}

void keepRows(MeasuredTable& table, const std::vector<bool>& keep) {
  const auto shorten = [&](std::vector<double>& column) {
    std::size_t row = 0;
    std::erase_if(column, [&](double) { return !keep[row++]; });
  };
  shorten(table.t);
  for (const Quantity& quantity : kQuantities)
    for (std::vector<double>& column : table.*quantity.columns) shorten(column);
}

MeasuredTable parseMeasuredRows(std::string_view text, const std::string& file) {
  return parseRows(table_files::columnsOfCsv(text, file), file);
}

std::vector<NamedColumn> namedColumns(const MeasuredTable& table, const std::vector<bool>& revolute) {
  std::vector<NamedColumn> columns = {{"t", "s", "time of the sample", &table.t}};
  for (const Quantity& quantity : kQuantities) {
    const TableColumns& values = table.*quantity.columns;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool linear = quantity.by_joint && k < revolute.size() && !revolute[k];
      columns.push_back({columnName(quantity, k), std::string(linear ? quantity.linear_unit : quantity.unit),
                         fmt::format("{} {}", quantity.meaning, k + 1), &values[k]});
    }
  }
  return columns;
}

std::string measuredTableHeader(const MeasuredTable& table) {
  std::string text;
  for (const NamedColumn& column : namedColumns(table)) text += (text.empty() ? "" : ",") + column.name;
  return text + '\n';
}

std::string formatMeasuredRow(const MeasuredTable& table, std::size_t row) {
  std::string text;
  table_files::appendCsvRow(namedColumns(table), row, text);
  return text;
}

std::string formatMeasuredTable(const MeasuredTable& table) {
  return table_files::formatCsv(namedColumns(table));
}

}  // namespace capstan::recording
