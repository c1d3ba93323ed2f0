#pragma once

#include <filesystem>
#include <functional>

#include "core/table_files/column_target.h"

namespace capstan::table_files {

/// Does `read(target)`, which reads the HDF5 file at `path`, in a process of its own, and gives the columns
/// to `target` here. HDF5 1.10 writes and frees memory that is not its own when a file is damaged on purpose
/// or by chance: then that process ends, and this one throws base::InputError. The process has limits of
/// memory (that of the columns and 512 MiB) and of processor time (60 s and 1 s per MiB of the file). A
/// base::InputError of `read` is thrown here with its parts.
void readInProcess(const std::filesystem::path& path, const ColumnTarget& target,
                   const std::function<void(const ColumnTarget& target)>& read);

}  // namespace capstan::table_files
