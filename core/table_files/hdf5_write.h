#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/table_files/named_column.h"

namespace capstan::table_files {

/// Attributes of the root group of an HDF5 file: name and text.
using FileAttributes = std::vector<std::pair<std::string, std::string>>;

/// Writes an HDF5 file: data sets of 64-bit floating-point numbers in chunks, compressed by gzip after
/// shuffling, each with the attributes `unit` and `meaning`. A former file stays until commit(). All
/// functions throw base::InputError when the file cannot be written.
class Hdf5Writer {
 public:
  Hdf5Writer(const std::filesystem::path& path, const FileAttributes& attributes);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Begins the data sets of a table in the group `group` ("/": root; others are made) with the attribute
  /// `meaning`. Only the names, units and meanings of `columns` are used.
  void beginTable(const std::string& group, const std::string& meaning, std::span<const NamedColumn> columns);
  /// Appends the values of `columns` to the data sets of the table begun last.
  void append(std::span<const NamedColumn> columns);
  /// Completes the file and moves it to its name.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes one table into the root group.
void writeHdf5(const std::filesystem::path& path, std::span<const NamedColumn> columns,
               const FileAttributes& attributes);

}  // namespace capstan::table_files
