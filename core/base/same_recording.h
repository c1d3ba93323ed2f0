#pragma once

#include <filesystem>

namespace capstan::base {

/// Whether both paths are one recording: the same file, or files with the same bytes (checksumOfFile()). A
/// recording that is used twice would count as new information. False when a file cannot be read: the error
/// is reported when the file is opened.
bool sameRecording(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace capstan::base
