#include "core/table_files/table_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

namespace capstan::table_files {
namespace {

constexpr std::array<std::string_view, 1> kCsvSuffixes = {".csv"};
constexpr std::array<std::string_view, 1> kJsonLinesSuffixes = {".jsonl"};
constexpr std::array<std::string_view, 2> kHdf5Suffixes = {".h5", ".hdf5"};
constexpr std::array<std::string_view, 1> kMatlabSuffixes = {".mat"};

constexpr std::array kKinds = {
    TableKindFacts{TableKind::kCsv, "CSV", kCsvSuffixes},
    TableKindFacts{TableKind::kJsonLines, "JSON Lines", kJsonLinesSuffixes},
    TableKindFacts{TableKind::kHdf5, "HDF5", kHdf5Suffixes},
    TableKindFacts{TableKind::kMatlab, "MATLAB", kMatlabSuffixes},
};

TableKind kindByFirstBytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 8> bytes{};
  in.read(bytes.data(), bytes.size());
  const std::string_view first(bytes.data(), static_cast<std::size_t>(in.gcount()));
  if (first == "\x89HDF\r\n\x1a\n") return TableKind::kHdf5;
  if (first.starts_with("MATLAB ")) return TableKind::kMatlab;
  const std::size_t text = first.find_first_not_of(" \t");
  if (text != std::string_view::npos && first[text] == '{') return TableKind::kJsonLines;
  return TableKind::kCsv;
}

}  // namespace

std::span<const TableKindFacts> tableKinds() { return kKinds; }

std::string tableSuffixes(std::string_view separator) {
  std::string text;
  for (const TableKindFacts& kind : kKinds)
    for (const std::string_view suffix : kind.suffixes)
      text += (text.empty() ? "" : std::string(separator)) + std::string(suffix);
  return text;
}

const TableKindFacts* kindBySuffix(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const TableKindFacts& kind : kKinds)
    if (std::find(kind.suffixes.begin(), kind.suffixes.end(), suffix) != kind.suffixes.end()) return &kind;
  return nullptr;
}

TableKind kindOf(const std::filesystem::path& path) {
  const TableKindFacts* known = kindBySuffix(path);
  return known ? known->kind : kindByFirstBytes(path);
}

}  // namespace capstan::table_files
