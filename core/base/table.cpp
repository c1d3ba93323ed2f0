#include "core/base/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

namespace capstan::base {
namespace {

constexpr const char* kDash = "–";

bool isEmpty(const TableCell& cell) { return cell.text.empty() && !std::isfinite(cell.number); }

std::string header(const TableColumn& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

/// Whether the column has a cell of text. Such a column is aligned to the left.
bool isText(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return column < row.size() && !row[column].text.empty(); });
}

TableCell cellAt(const std::vector<TableCell>& row, std::size_t column) {
  return column < row.size() ? row[column] : TableCell{};
}

bool alike(const TableCell& a, const TableCell& b) {
  return a.text == b.text && (a.number == b.number || (std::isnan(a.number) && std::isnan(b.number)));
}

/// Whether the cell repeats the cell above it (TableColumn::grouped).
bool isRepeated(const Table& table, std::size_t row, std::size_t column) {
  if (row == 0 || !table.columns[column].grouped) return false;
  for (std::size_t i = 0; i <= column; ++i)
    if (table.columns[i].grouped && !alike(cellAt(table.rows[row], i), cellAt(table.rows[row - 1], i)))
      return false;
  return true;
}

std::string markdownEscaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '\\' || c == '*' || c == '<' || c == '`') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

/// Number of UTF-8 characters.
std::size_t charactersIn(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// LaTeX source of a number such as "2.6e-09" as a power of ten.
std::string latexNumber(const std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text.starts_with('-') ? "$-$" + text.substr(1) : text;
  return fmt::format("${} \\times 10^{{{}}}$", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

constexpr std::pair<std::string_view, std::string_view> kLatex[] = {
    {"\\", "\\textbackslash{}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"–", "--"},
    {"—", "---"},
    {"…", "\\ldots{}"},
    {"±", "$\\pm$"},
    {"·", "$\\cdot$"},
    {"×", "$\\times$"},
    {"−", "$-$"},
    {"≤", "$\\leq$"},
    {"≥", "$\\geq$"},
    {"°", "$^\\circ$"},
    {"²", "$^2$"},
    {"³", "$^3$"},
    {"σ", "$\\sigma$"},
    {"χ", "$\\chi$"},
    {"µ", "$\\mu$"},
    {"→", "$\\rightarrow$"},
    {"’", "'"},
};

}  // namespace

std::string cellText(const TableCell& cell, const TableColumn& column) {
  if (!cell.text.empty()) return cell.text;
  if (isEmpty(cell)) return kDash;
  if (column.style == NumberStyle::kSignificant) return fmt::format("{:.{}g}", cell.number, column.digits);
  const std::string text = fmt::format("{:.{}f}", cell.number, column.digits);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string latexEscaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto found = std::find_if(std::begin(kLatex), std::end(kLatex),
                                    [&](const auto& entry) { return rest.starts_with(entry.first); });
    if (found == std::end(kLatex)) {
      out += text[i++];
    } else {
      out += found->second;
      i += found->first.size();
    }
  }
  return out;
}

std::string markdownOf(const Table& table) {
  const std::size_t count = table.columns.size();
  std::vector<std::vector<std::string>> lines(1);
  for (const TableColumn& column : table.columns) lines[0].push_back(markdownEscaped(header(column)));
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    auto& line = lines.emplace_back();
    for (std::size_t i = 0; i < count; ++i)
      line.push_back(isRepeated(table, row, i)
                         ? std::string()
                         : markdownEscaped(cellText(cellAt(table.rows[row], i), table.columns[i])));
  }
  std::string text = table.title.empty() ? "" : "### " + markdownEscaped(table.title) + "\n\n";
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::string rule;
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t width = 3;
      for (const auto& line : lines) width = std::max(width, charactersIn(line[i]));
      const std::string padding(width - charactersIn(lines[n][i]), ' ');
      const bool left = isText(table, i);
      text += "| " + (left ? lines[n][i] + padding : padding + lines[n][i]) + " ";
      rule += left ? "|:" + std::string(width + 1, '-') : "|" + std::string(width + 1, '-') + ":";
    }
    text += "|\n";
    if (n == 0) text += rule + "|\n";
  }
  if (!table.note.empty()) text += "\n" + markdownEscaped(table.note) + "\n";
  return text;
}

std::string latexOf(const Table& table, const std::string& label) {
  std::string text = "\\begin{table}\n  \\centering\n";
  if (!table.title.empty()) text += "  \\caption{" + latexEscaped(table.title) + "}\n";
  if (!label.empty()) text += "  \\label{" + label + "}\n";
  std::string alignment, names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    alignment += isText(table, i) ? 'l' : 'r';
    names += (i == 0 ? "    " : " & ") + latexEscaped(header(table.columns[i]));
  }
  text += "  \\begin{tabular}{" + alignment + "}\n    \\toprule\n" + names + " \\\\\n    \\midrule\n";
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const TableCell cell = cellAt(table.rows[row], i);
      const std::string shown = isRepeated(table, row, i) ? std::string() : cellText(cell, table.columns[i]);
      const bool number = !shown.empty() && cell.text.empty() && !isEmpty(cell);
      text += (i == 0 ? "    " : " & ") + (number ? latexNumber(shown) : latexEscaped(shown));
    }
    text += " \\\\\n";
  }
  text += "    \\bottomrule\n  \\end{tabular}\n";
  if (!table.note.empty())
    text += "  \\par\\smallskip\n  {\\footnotesize " + latexEscaped(table.note) + "}\n";
  return text + "\\end{table}\n";
}

std::string csvQuoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csvOf(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    text += (i == 0 ? "" : ",") + csvQuoted(header(table.columns[i]));
  text += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const TableCell cell = cellAt(row, i);
      if (i > 0) text += ',';
      if (!cell.text.empty())
        text += csvQuoted(cell.text);
      else if (!isEmpty(cell))
        text += fmt::format("{}", cell.number);
    }
    text += '\n';
  }
  return text;
}

}  // namespace capstan::base
