#pragma once

#include <filesystem>
#include <span>

#include "core/table_files/hdf5_write.h"
#include "core/table_files/matlab.h"
#include "core/table_files/named_column.h"

namespace capstan::table_files {

/// Writes a table into a file of the kind that the suffix of `path` names, CSV if it names none. HDF5 files
/// also hold `attributes`. Every kind gives the numbers back to the last bit. Throws base::InputError when
/// the file cannot be written.
void writeColumns(const std::filesystem::path& path, std::span<const NamedColumn> columns,
                  const FileAttributes& attributes, MatlabVersion matlab);

/// Appends one row as CSV: NaN is an empty cell, other numbers have the shortest decimals that read back to
/// the last bit.
void appendCsvRow(std::span<const NamedColumn> columns, std::size_t row, std::string& text);
/// The table as CSV text: a header line, then its rows.
std::string formatCsv(std::span<const NamedColumn> columns);

}  // namespace capstan::table_files
