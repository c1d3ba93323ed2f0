#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::table_files {

/// Kinds of files that hold a table of numbers.
enum class TableKind { kCsv, kJsonLines, kHdf5, kMatlab };

/// What the program says of a kind of files. Commands, dialogs and errors take their lists from here.
struct TableKindFacts {
  TableKind kind;
  std::string_view name;                       ///< "JSON Lines"
  std::span<const std::string_view> suffixes;  ///< with the point; the first is the usual one
};

/// All kinds, in the order of lists.
std::span<const TableKindFacts> tableKinds();
/// Suffixes of all kinds: ".csv, .jsonl, .h5, .hdf5, .mat".
std::string tableSuffixes(std::string_view separator = ", ");
/// Kind with the suffix of `path`, in small or capital letters; null: no kind has it.
const TableKindFacts* kindBySuffix(const std::filesystem::path& path);
/// Kind of the file at `path` by its suffix; of a file with another suffix by its first bytes. A file of no
/// other kind is CSV.
TableKind kindOf(const std::filesystem::path& path);

}  // namespace capstan::table_files
