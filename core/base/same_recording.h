#pragma once

#include <filesystem>

namespace capstan::base {

/// Both are one recording: the same file, or files of the same bytes (base::checksumOfFile()). Taken twice it
/// would count as new information. A file that cannot be read is like no other: whoever opens it reports it.
bool sameRecording(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace capstan::base
