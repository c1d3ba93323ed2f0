#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/table_files/column_target.h"
#include "core/table_files/named_column.h"

namespace capstan::table_files {

/// Versions of MATLAB files that are written. Version 5 is read by MATLAB, Octave and SciPy; 7.3, which is
/// HDF5, by MATLAB and HDF5 tools, and has no limit of 2 GiB for a column.
enum class MatlabVersion { k5, k73 };

/// Reads the columns of a MATLAB file of version 5 (also compressed, as `save -v7` makes it) or 7.3 at
/// `path`. A column is a real numeric vector, row or column, among the file's variables; if these have no
/// `t`, among the fields of its only structure. Throws base::InputError as readHdf5().
void readMatlab(const std::filesystem::path& path, const ColumnTarget& target);

/// Writes each column as a variable, a column vector of doubles. Throws base::InputError when the file cannot
/// be written, and for a column that is too long for version 5.
void writeMatlab(const std::filesystem::path& path, std::span<const NamedColumn> columns,
                 MatlabVersion version);

}  // namespace capstan::table_files
