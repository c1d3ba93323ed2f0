#include "app/cli/diagnose_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/hypotheses/pose_hypotheses.h"
#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"

namespace capstan::cli {
namespace {

using diagnosis::Cause;
using diagnosis::Report;

constexpr std::size_t kWidth = 100;
constexpr std::size_t kRanked = 6;  ///< number of candidates shown per round

/// Number of characters of a UTF-8 text.
std::size_t charactersIn(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string headerOf(const base::TableColumn& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

std::vector<std::vector<std::string>> cellsOf(const base::Table& table) {
  std::vector<std::vector<std::string>> cells(1);
  for (const base::TableColumn& column : table.columns) cells.front().push_back(headerOf(column));
  for (const auto& row : table.rows) {
    cells.emplace_back();
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      cells.back().push_back(base::cellText(i < row.size() ? row[i] : base::TableCell{}, table.columns[i]));
  }
  return cells;
}

bool isWords(const base::Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return column < row.size() && !row[column].text.empty(); });
}

std::string commanded(const char* name, std::string_view words) {
  return words.empty() ? std::string() : wrapped(fmt::format("{}: {}", name, words), 2);
}

/// `among`: what the probability is relative to; empty: it is that of the effect.
std::string causeBlock(const Cause& cause, const char* among = "") {
  std::string text = wrapped(diagnosis::causeText(cause));
  text += wrapped(fmt::format("probability {:.0f} %{}", 100.0 * cause.probability, among), 2);
  if (!cause.moves.joints.empty()) text += wrapped(diagnosis::movesText(cause), 2);
  if (!cause.gain.channel.empty()) text += wrapped(diagnosis::gainText(cause.gain), 2);
  if (const diagnosis::HypothesisWords* words = diagnosis::wordsOf(cause.effect))
    text += commanded("what it is", words->what) + commanded("shown best by", words->experiment);
  return text + "\n";
}

std::string tieBlock(const diagnosis::Tie& tie) {
  std::string text = "One of these causes, which the recordings cannot distinguish:\n\n";
  for (const Cause& cause : diagnosis::mostProbableFirst(tie)) text += causeBlock(cause, " among these");
  if (!tie.separate.empty()) text += wrapped("What would distinguish them: " + tie.separate) + "\n";
  return text;
}

std::string causesText(const Report& report) {
  std::string text;
  for (const Cause& cause : report.causes) {
    const diagnosis::Tie* tie = diagnosis::tieOfCause(report, cause);
    text += tie ? tieBlock(*tie) : causeBlock(cause);
  }
  return text;
}

std::string nextText(const Report& report) {
  return report.next ? wrapped(diagnosis::sentenceOf(*report.next)) + "\n" : std::string();
}

std::string alsoMeasurableText(const Report& report) {
  if (report.also_measurable.empty()) return {};
  std::string text = diagnosis::alsoMeasurableTitle(report) + ":\n";
  for (const Cause& cause : report.also_measurable)
    text += wrapped(diagnosis::causeText(cause) + "; " + diagnosis::movesText(cause), 2);
  return text + "\n";
}

std::string unexplainedText(const Report& report) {
  std::string text;
  for (const diagnosis::ResidualProcess& process : report.processes)
    if (process.end == diagnosis::ProcessEnd::kDone)
      text += wrapped("The residual of " + process.channel + " " + process.words + ".") + "\n";
  if (!report.lines.empty()) text += plainText(diagnosis::lineTable(report)) + "\n";
  return text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::string all, line;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    if (!line.empty() && indent + charactersIn(line) + 1 + charactersIn(word) > kWidth) {
      all += margin + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? all : all + margin + line + "\n";
}

std::string plainText(const base::Table& table) {
  const auto cells = cellsOf(table);
  std::vector<std::size_t> widths(table.columns.size(), 0);
  for (const auto& row : cells)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], charactersIn(row[i]));
  std::string text = table.title + "\n";
  for (const auto& row : cells) {
    std::string line = "  ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - charactersIn(row[i]), ' ');
      line += (isWords(table, i) ? row[i] + space : space + row[i]) + "  ";
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text + wrapped(table.note, 2);
}

std::string textOf(const Report& report) {
  std::string text = report.cancelled ? "Cancelled: no verdict. Results until then:\n\n"
                                      : wrapped(report.summary) + wrapped(diagnosis::tipText(report)) + "\n" +
                                            causesText(report) + alsoMeasurableText(report) +
                                            unexplainedText(report) + nextText(report);
  if (!report.channels.empty()) text += plainText(diagnosis::channelTable(report)) + "\n";
  if (!report.explainable.empty()) text += plainText(diagnosis::explainableTable(report)) + "\n";
  if (report.posterior.size() > 1) text += plainText(diagnosis::posteriorTable(report, kRanked)) + "\n";
  if (!report.refit.empty()) text += plainText(diagnosis::refitTable(report)) + "\n";
  if (!report.candidates.empty()) text += plainText(diagnosis::rankingTable(report, kRanked)) + "\n";
  if (!report.filter.empty()) text += plainText(diagnosis::filterTable(report)) + "\n";
  if (report.cancelled) return text;
  double seconds = 0.0;
  for (const diagnosis::Stage& stage : report.stages) seconds += stage.seconds;
  return text + fmt::format("verdict: {}, in {:.1f} s of computing\n", base::nameOf(report.verdict), seconds);
}

}  // namespace capstan::cli
