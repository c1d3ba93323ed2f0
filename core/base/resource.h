#pragma once

#include <filesystem>

namespace capstan::base {

/// Path of a file of the resources folder (robot files, cameras, truths, options, style, manual). The folders
/// are searched in this order: the environment variable CAPSTAN_RESOURCES, share/capstan beside the program's
/// folder, and the folder that CMake's CAPSTAN_RESOURCES named (default: the source tree). Throws InputError
/// when `file` is in none of them.
std::filesystem::path resource(const std::filesystem::path& file);

}  // namespace capstan::base
