#include "tests/support/planted_study/study_tables.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/yaml.h"
#include "core/stats/quantile.h"

namespace capstan::study {
namespace {

using base::Table;
using base::TableCell;

base::TableColumn words(std::string name) {
  base::TableColumn column;
  column.name = std::move(name);
  return column;
}

base::TableColumn number(std::string name, std::string unit, int digits) {
  base::TableColumn column = words(std::move(name));
  column.unit = std::move(unit);
  column.digits = digits;
  column.style = base::NumberStyle::kSignificant;
  return column;
}

base::TableColumn count(std::string name) {
  base::TableColumn column = words(std::move(name));
  column.digits = 0;
  return column;
}

base::TableColumn percent(std::string name) {
  base::TableColumn column = words(std::move(name));
  column.unit = "%";
  column.digits = 1;
  return column;
}

std::string limitWords(const DetectionLimit& limit) {
  switch (limit.kind) {
    case DetectionLimit::Kind::kWithin:
      return fmt::format("{:.2f} ({:.2f}–{:.2f})", limit.size, limit.low, limit.high);
    case DetectionLimit::Kind::kBelow:
      return fmt::format("< {:.2f}", limit.size);
    case DetectionLimit::Kind::kAbove:
      return fmt::format("> {:.2f}", limit.size);
    case DetectionLimit::Kind::kTooFew:
      break;
  }
  return "too few";
}

std::string goalWords(const Aim& aim) {
  if (aim.goal == Aim::Goal::kNone) return "";
  return fmt::format("{} {:.0f}", aim.goal == Aim::Goal::kAtLeast ? "≥" : "≤", 100.0 * aim.aim);
}

std::string metWords(const Aim& aim) {
  if (aim.goal == Aim::Goal::kNone || aim.result.trials == 0) return "";
  return aim.met() ? "met" : "not met";
}

Table goalTable(const Summary& summary) {
  Table table;
  table.title = "Goals";
  table.columns = {words("what"),   count("of"),   count("hits"), percent("share"),
                   percent("from"), percent("to"), words("goal"), words("met")};
  for (const Aim& aim : summary.aims) {
    const stats::Interval interval = aim.result.interval();
    table.rows.push_back({aim.what, double(aim.result.trials), double(aim.result.hits),
                          100.0 * aim.result.share(), 100.0 * interval.low, 100.0 * interval.high,
                          goalWords(aim), metWords(aim)});
  }
  table.note = "Intervals: 95 %, Clopper and Pearson. False alarm: any verdict but \"nothing\".";
  return table;
}

Table groupTable(std::string title, const std::vector<Group>& groups, bool limits) {
  Table table;
  table.title = std::move(title);
  table.columns = {words(limits ? "planted" : "of"), count("cases")};
  for (const auto& [hit, name] : base::NamesOf<Hit>::value) table.columns.push_back(count(name));
  table.columns.push_back(words("numbers inside"));
  if (limits) {
    table.columns.push_back(words("half found from size"));
    table.columns.push_back(number("true model's", "", 2));
  }
  for (const Group& group : groups) {
    std::vector<TableCell> row = {group.name, double(group.cases())};
    for (const int count : group.hits) row.emplace_back(double(count));
    row.emplace_back(fmt::format("{} of {}", group.numbers.hits, group.numbers.trials));
    if (limits) {
      row.emplace_back(limitWords(group.limit));
      row.emplace_back(group.ideal);
    }
    table.rows.push_back(std::move(row));
  }
  if (limits)
    table.note =
        "Half found from size: isotonic regression, a tie with it counts; in brackets the sizes between "
        "which "
        "it lies. True model's: the size that an observer with the true model would find in half of all.";
  return table;
}

Table confusionTable(const Confusion& confusion) {
  Table table;
  table.title = "Planted by first named";
  table.columns = {words("planted")};
  for (std::size_t k = 0; k < confusion.named.size(); ++k) {
    table.columns.push_back(count(fmt::format("{}", k + 1)));
    table.note += fmt::format("{}{} {}", k == 0 ? "" : ", ", k + 1, confusion.named[k]);
  }
  for (const std::string& planted : confusion.planted) {
    std::vector<TableCell> row = {planted};
    for (const std::string& named : confusion.named) {
      const auto found = confusion.counts.find({planted, named});
      row.emplace_back(found == confusion.counts.end() ? std::nan("") : found->second);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table missTable(const Summary& summary) {
  Table table;
  table.title = "Cases that came out wrong";
  table.columns = {words("case"), words("planted"), number("visibility", "", 3), words("said"),
                   words("ranked first")};
  for (const Miss& miss : summary.misses) {
    const auto& items = miss.outcome.truth.items;
    std::string ranked;
    for (const RankedCause& one : miss.outcome.answer.candidates)
      ranked += fmt::format("{}{} {}", ranked.empty() ? "" : ", ", one.effect, one.joint);
    table.rows.push_back({miss.outcome.of.name(), miss.planted,
                          items.empty() ? TableCell() : TableCell(items.front().visibility), miss.said,
                          ranked});
  }
  return table;
}

Table outsideTable(const Summary& summary) {
  Table table;
  table.title = "Numbers outside their 95 %";
  table.columns = {words("case"),
                   words("number"),
                   number("planted", "SI", 4),
                   number("found", "SI", 4),
                   number("sigma", "SI", 3),
                   number("sigmas off", "", 3)};
  for (const auto& [name, check] : summary.outside)
    table.rows.push_back({name, check.name, check.planted, check.found, check.sigma,
                          check.sigma > 0.0 ? (check.found - check.planted) / check.sigma : std::nan("")});
  return table;
}

}  // namespace

std::vector<StudyTable> tablesOf(const Summary& summary) {
  return {{"goals", goalTable(summary)},
          {"effects", groupTable("Effects", summary.effects, true)},
          {"groups", groupTable("Groups of cases with one effect", summary.groups, false)},
          {"confusion", confusionTable(summary.confusion)},
          {"misses", missTable(summary)},
          {"outside", outsideTable(summary)}};
}

std::string markdownOf(const Summary& summary) {
  std::string text = "# Diagnosis of planted effects\n\n";
  if (!summary.seconds.empty())
    text += fmt::format("{} recordings; a diagnosis takes {:.1f} s (median), {:.1f} s at most.\n\n",
                        summary.seconds.size(), stats::median(summary.seconds), summary.seconds.back());
  for (const StudyTable& one : tablesOf(summary)) text += base::markdownOf(one.table) + "\n";
  return text;
}

void writeTables(const Summary& summary, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  base::writeTextFile(folder / "study.md", markdownOf(summary));
  for (const StudyTable& one : tablesOf(summary)) {
    base::Table table = one.table;
    if (one.name == "confusion")
      for (std::size_t k = 0; k < summary.confusion.named.size(); ++k)
        table.columns[k + 1].name = summary.confusion.named[k];
    base::writeTextFile(folder / (one.name + ".csv"), base::csvOf(table));
  }
}

}  // namespace capstan::study
