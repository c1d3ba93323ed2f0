#pragma once

#include <limits>
#include <string>
#include <vector>

namespace capstan::base {

/// Number format of a column.
enum class NumberStyle {
  kFixed,       ///< `digits` decimals
  kSignificant  ///< `digits` significant digits; small and large numbers as a power of ten
};

struct TableColumn {
  std::string name;
  std::string unit;  ///< unit as people read it; empty when there is none
  int digits = 3;
  NumberStyle style = NumberStyle::kFixed;
  /// Whether equal cells of consecutive rows are shown only in the first of these rows; a CSV has them in
  /// every row. Rows form a group when their cells agree in this column and in all grouped columns before it.
  bool grouped = false;
};

/// Number or text of a cell. A number that is not finite is an empty cell: a dash, in a CSV nothing.
struct TableCell {
  std::string text;
  double number = std::numeric_limits<double>::quiet_NaN();

  TableCell() = default;
  TableCell(double value) : number(value) {}
  TableCell(std::string words) : text(std::move(words)) {}
  TableCell(const char* words) : text(words) {}
};

/// Table for people and programs. All texts are plain UTF-8; each writer escapes them for its own format.
struct Table {
  std::string title;
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;  ///< one cell per column
  std::string note;                          ///< text below the table; empty when there is none
};

/// Text of the cell in its column's format; "–" for an empty cell. Powers of ten are written as in 2.6e-09.
std::string cellText(const TableCell& cell, const TableColumn& column);

/// Markdown text: a heading, the table and its note. The columns are padded so that the text is also readable
/// unrendered; columns of numbers are aligned to the right.
std::string markdownOf(const Table& table);
/// LaTeX table environment with booktabs rules and, when `label` is given, a \label. Needs only booktabs.
std::string latexOf(const Table& table, const std::string& label = {});
/// CSV text: a header line (`name [unit]`), one line per row, exact numbers, cells quoted as needed.
std::string csvOf(const Table& table);
/// `text` as a CSV cell (RFC 4180): quoted if it has a comma, a quote or a line end.
std::string csvQuoted(const std::string& text);

/// LaTeX source that prints `text` unchanged: LaTeX's special characters, and the UTF-8 characters in the
/// tables of this program (–, ±, ·, ×, Greek letters, superscripts), become commands that every engine knows.
std::string latexEscaped(const std::string& text);

}  // namespace capstan::base
