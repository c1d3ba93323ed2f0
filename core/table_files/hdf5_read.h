#pragma once

#include <filesystem>

#include "core/table_files/column_target.h"

namespace capstan::table_files {

/// Reads, in a process of its own (hdf5_process.h), the columns of the HDF5 file at `path`, and of MATLAB
/// files of version 7.3, which are HDF5 files. A column is a data set of numbers with one dimension, or with
/// two of which one is 1, in the root group; if that has no data set `t`, in the only group that has one.
/// Links to other files are not followed. Rows are read in pieces of 65,536. Throws base::InputError naming
/// file, data set, value and remedy for a file that is no HDF5 file or is damaged, a data set of another
/// shape or type, columns of different length, more rows than the file can hold, an infinite value, and a
/// table without rows.
void readHdf5(const std::filesystem::path& path, const ColumnTarget& target);

}  // namespace capstan::table_files
