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
#include <optional>
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

/// Number of edits that make the column `meant` of the unused column `name`; nothing: it is another word.
std::optional<std::size_t> editsTo(std::string_view meant, std::string_view name) {
  constexpr std::size_t kLongest = 24;  // of a name that is examined
  if (name.size() > kLongest) return {};
  const std::string letters = lettersOf(name), wanted = lettersOf(meant);
  if (meant == "t") {
    const bool time = letters == "t" || letters.find("time") != std::string::npos ||
                      letters.find("stamp") != std::string::npos;
    return time ? std::optional(letters.size()) : std::nullopt;
  }
  if (letters.size() < 2 || letters.back() != wanted.back()) return {};  // the number of the joint
  const std::size_t edits = base::editDistance(letters, wanted);
  // m1 for q_m1 has lost its begin.
  const bool near = edits <= (wanted.size() - 1) / 3 || (edits == 1 && wanted.ends_with(letters));
  return near ? std::optional(edits) : std::nullopt;
}

/// The unused column that is probably a misspelled `meant`; empty: none.
std::string misspelledAs(std::string_view meant, const std::vector<std::string>& unused) {
  std::string nearest;
  std::optional<std::size_t> least;
  for (const std::string& name : unused)
    if (const auto edits = editsTo(meant, name); edits && (!least || *edits < *least))
      least = edits, nearest = name;
  return nearest;
}

std::string unusedText(const std::vector<std::string>& columns) {
  constexpr std::size_t kMost = 8;  // names in a message
  if (columns.empty()) return {};
  const std::vector<std::string> first(
      columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(std::min(columns.size(), kMost)));
  const std::string more =
      columns.size() > kMost ? fmt::format(" and {} more", columns.size() - kMost) : std::string();
  return fmt::format("; not used: {}{}", fmt::join(first, ", "), more);
}

/// A name of a column that fits a message: a stranger's may have a megabyte.
std::string shownName(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  if (name.size() <= kLongest) return std::string(name);
  std::size_t length = kLongest;
  while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xc0U) == 0x80U) --length;  // whole UTF-8
  return std::string(name.substr(0, length)) + "…";
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
      table_.ignored.push_back(shownName(name));
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
    std::string highest;  // column of a joint with the largest number
    for (std::size_t i = 0; i < kQuantities.size(); ++i) {
      const std::size_t have = kQuantities[i].by_joint ? lastPresent(found_[i]) : 0;
      if (have > joints) joints = have, highest = columnName(kQuantities[i], have - 1);
    }
    for (std::size_t i = 0; i < kQuantities.size(); ++i) {
      const Quantity& quantity = kQuantities[i];
      const std::size_t have = lastPresent(found_[i]);
      if (have == 0) continue;
      for (std::size_t k = 0; k < (quantity.by_joint ? joints : 3); ++k) {
        if (!found_[i][k].present) {
          const std::string other = quantity.by_joint ? highest : columnName(quantity, have - 1);
          refuseMissing(table_, columnName(quantity, k),
                        fmt::format("is missing, yet the table has {}", other),
                        fmt::format("Add it, or correct the number in {}", other));
        }
        (table_.*quantity.columns).push_back(std::move(found_[i][k].values));
      }
    }
  }

 private:
  struct Found {
    bool present = false;
    std::vector<double> values;
  };
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
  const std::string misspelled = misspelledAs(name, table.ignored);
  if (misspelled.empty()) return;
  std::vector<std::string> others = table.ignored;
  std::erase(others, misspelled);
  throw base::InputError(
      {table.file,
       table.lines.header(),
       misspelled,
       {},
       fmt::format("is no column of a measured table; {} is missing{}", name, unusedText(others)),
       fmt::format("Rename it to {}, if that is what it holds", name)});
}

void refuseMissing(const MeasuredTable& table, const std::string& name, const std::string& reason,
                   const std::string& remedy) {
  refuseMisspelled(table, name);
  throw base::InputError(
      {table.file, table.lines.header(), name, {}, reason + unusedText(table.ignored), remedy});
}

std::string columnMeantBy(const MeasuredTable& table, const std::string& name) {
  std::string nearest;
  std::optional<std::size_t> least;
  for (const Quantity& quantity : kQuantities) {
    const int most = quantity.by_joint ? std::min(table.joints() + 1, kMaxJoints) : 3;
    for (auto k = (table.*quantity.columns).size(); k < static_cast<std::size_t>(most); ++k) {
      const std::string meant = columnName(quantity, k);
      const auto edits = editsTo(meant, name);
      if (edits && (!least || *edits < *least)) least = edits, nearest = meant;
    }
  }
  return nearest;
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
