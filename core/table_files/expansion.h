#pragma once

#include <algorithm>
#include <cstdint>

namespace capstan::table_files {

/// Limit of compressed files, so that a small file of a stranger cannot fill the memory: the columns that are
/// read have at most this many times the bytes of the file. A recording of 11 columns that all stand still
/// but the time, compressed by gzip, has 40.
inline constexpr std::uint64_t kLargestExpansion = 256;
inline constexpr std::uint64_t kAlwaysAllowed = 16U
                                                << 20;  ///< columns of this many bytes are read in any case

/// Most bytes of columns, as doubles, that are read from a compressed file of `file_bytes`.
inline std::uint64_t mostColumnBytes(std::uint64_t file_bytes) {
  return std::max(kAlwaysAllowed, kLargestExpansion * file_bytes);
}

}  // namespace capstan::table_files
