#pragma once

#include <filesystem>

namespace capstan::base {

/// Path of a file of the resources folder (robot files, cameras, truths, options, style, manual): in the
/// folder that CAPSTAN_RESOURCES of the environment names, in share/capstan beside the program's folder, or
/// in the source tree, in this order. Throws InputError when `file` is in none of them.
std::filesystem::path resource(const std::filesystem::path& file);

}  // namespace capstan::base
