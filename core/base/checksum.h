#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace capstan::base {

/// 64-bit FNV-1a checksum of `text`, as 16 hexadecimal digits (http://www.isthe.com/chongo/tech/comp/fnv). It
/// detects a damaged or a different text, but not a forged one.
std::string checksumOf(std::string_view text);

/// Checksum of the bytes of `file`, as checksumOf(). Throws InputError when the file cannot be read.
std::string checksumOfFile(const std::filesystem::path& file);

}  // namespace capstan::base
