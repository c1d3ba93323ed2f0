#pragma once

#include <limits>
#include <string>
#include <vector>

namespace capstan::base {

/// How a column writes its numbers.
enum class NumberStyle {
  kFixed,       ///< `digits` decimals
  kSignificant  ///< `digits` significant ones, as a power of ten where the number is small or large
};

struct TableColumn {
  std::string name;
  std::string unit;  ///< as people read it; empty: none
  int digits = 3;
  NumberStyle style = NumberStyle::kFixed;
  /// Of rows that belong together, readers see the cell in the first only; in a CSV it stands in each. Rows
  /// belong together where the cells of this column and the grouped ones before it are alike.
  bool grouped = false;
};

/// A number or a text. A number that is not finite is an empty cell: a dash for readers, nothing in a CSV.
struct TableCell {
  std::string text;
  double number = std::numeric_limits<double>::quiet_NaN();

  TableCell() = default;
  TableCell(double value) : number(value) {}
  TableCell(std::string words) : text(std::move(words)) {}
  TableCell(const char* words) : text(words) {}
};

/// A table for people and programs. Plain text in UTF-8: each writer escapes what its format asks for.
struct Table {
  std::string title;
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;  ///< a cell for each column
  std::string note;                          ///< below the table; empty: none
};

/// The cell as its column writes it; "–" for an empty one. Powers of ten as in 2.6e-09.
std::string cellText(const TableCell& cell, const TableColumn& column);

/// A heading, the table and its note; readable as it stands, too: columns are aligned, those of numbers to
/// the right.
std::string markdownOf(const Table& table);
/// A table environment with booktabs rules and, where `label` is given, a \label. No other package is needed.
std::string latexOf(const Table& table, const std::string& label = {});
/// A header line (`name [unit]`), a line a row, numbers to the last bit, cells quoted where they need it.
std::string csvOf(const Table& table);

/// `text` so that LaTeX prints it as it stands: its special characters, and those of UTF-8 that tables of
/// this program use (–, ±, ·, ×, %, Greek letters, superscripts) as commands that every engine knows.
std::string latexEscaped(const std::string& text);

}  // namespace capstan::base
