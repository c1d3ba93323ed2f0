#include "core/analysis/session_record.h"

#include <gtest/gtest.h>

namespace capstan::analysis {
namespace {

/// The table of `record` whose name ends with `ending`.
base::Table tableOf(const SessionRecord& record, const std::string& ending) {
  for (auto& named : tablesOf(record))
    if (named.name.ends_with(ending)) return named.table;
  ADD_FAILURE() << "no table " << ending;
  return {};
}

TEST(SessionRecordTable, EventsAreInTheOrderOfTheirTimes) {
  SessionRecord record;
  record.run.title = "recording trial.capstan";
  record.run.name = "session";
  record.events = {{1.5, "robot", "first"},
                   {26.0, "session", "end"},
                   {3.089, "note", "written later"},
                   {3.089, "note", "and after it"}};
  const base::Table table = tableOf(record, "-events");
  EXPECT_EQ(table.title, "recording trial.capstan: events");
  ASSERT_EQ(table.rows.size(), 4U);
  std::vector<std::string> texts;
  for (const auto& row : table.rows) texts.push_back(row[2].text);
  EXPECT_EQ(texts, (std::vector<std::string>{"first", "written later", "and after it", "end"}));
}

}  // namespace
}  // namespace capstan::analysis
