#pragma once

#include <filesystem>

#include "core/table_files/column_target.h"

namespace capstan::table_files {

/// Reads the columns of a MATLAB file of version 5 as readMatlab() describes. The file is read in pieces of
/// 64 KiB, variables that are no columns are skipped. Throws base::InputError as readMatlab().
/// Format: "MAT-File Format", The MathWorks, version 5.
void readMatlab5(const std::filesystem::path& path, const ColumnTarget& target);

}  // namespace capstan::table_files
