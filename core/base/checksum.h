#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace capstan::base {

/// FNV-1a, 64 bit, as 16 hexadecimal digits (http://www.isthe.com/chongo/tech/comp/fnv): detects a damaged or
/// another text, not a forged one.
std::string checksumOf(std::string_view text);

/// The same of the bytes of `file`. Throws InputError where it cannot be read.
std::string checksumOfFile(const std::filesystem::path& file);

}  // namespace capstan::base
