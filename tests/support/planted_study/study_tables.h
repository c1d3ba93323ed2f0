#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/table.h"
#include "tests/support/planted_study/summary.h"

namespace capstan::study {

struct StudyTable {
  std::string name;  ///< of its file
  base::Table table;
};

/// goals, effects, groups, confusion (numbers in place of names, read for people: names of the columns stand
/// in the note), misses, outside.
std::vector<StudyTable> tablesOf(const Summary& summary);

/// All of them for people, under a heading with the number of cases and how long each took.
std::string markdownOf(const Summary& summary);

/// study.md and NAME.csv of each table into `folder`, which is made. base::InputError: it cannot be written.
void writeTables(const Summary& summary, const std::filesystem::path& folder);

}  // namespace capstan::study
