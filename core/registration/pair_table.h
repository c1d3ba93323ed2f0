#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/vision/triangulation.h"

namespace capstan::registration {

/// The same points in both frames, row by row [m].
struct PairTable {
  std::vector<Eigen::Vector3d> base, camera;
};

/// Reads a table of any kind: the tip in the base frame as x, y, z [m], and the marker in the left camera's
/// frame as cam_x, cam_y, cam_z [m], or as left_u, left_v, right_u, right_v [px], which `triangulator`
/// triangulates. Other columns are ignored. Throws base::InputError for a missing or repeated column, pixels
/// without a triangulator, a value that is not finite, and rays that do not meet.
PairTable readPairTable(const std::filesystem::path& path,
                        const std::optional<vision::Triangulator>& triangulator);

}  // namespace capstan::registration
