#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/recording/schema.h"
#include "core/recording/sqlite.h"

namespace capstan::recording {

/// Numbers of rows by SampleTable.
using RowCounts = std::array<std::int64_t, kSampleTables>;

/// Counts the rows; reads every leaf page.
RowCounts rowCounts(Database& database);

/// Header entry `rows`, "motor 12000, joint 12000, …", and its counts; nothing for another text.
std::string textOf(const RowCounts& counts);
std::optional<RowCounts> parseRowCounts(const std::string& text);

}  // namespace capstan::recording
