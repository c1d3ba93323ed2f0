#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/table.h"
#include "tests/support/planted_study/summary.h"

namespace capstan::study {

/// Table of a study, and the name of its file.
struct StudyTable {
  std::string name;
  base::Table table;
};

/// Tables of a study: goals, effects, groups, confusion (its columns are numbered, and the note lists their
/// names), misses, outside.
std::vector<StudyTable> tablesOf(const Summary& summary);

/// All tables as Markdown, under a heading with the number of cases and the time per case.
std::string markdownOf(const Summary& summary);

/// Writes study.md and one NAME.csv per table into `folder`, which is created if necessary. Throws
/// base::InputError if it cannot be written.
void writeTables(const Summary& summary, const std::filesystem::path& folder);

}  // namespace capstan::study
