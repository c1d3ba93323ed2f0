#pragma once

#include <filesystem>

#include "core/vision/marker.h"

namespace capstan::vision {

/// Marker file (YAML): the fields of MarkerOptions; those that are missing keep their defaults. Throws
/// base::InputError with file, line, key, value and range.
MarkerOptions readMarkerFile(const std::filesystem::path& path);
/// Writes every field. Throws base::InputError where the file cannot be written.
void writeMarkerFile(const MarkerOptions& marker, const std::filesystem::path& path);

}  // namespace capstan::vision
