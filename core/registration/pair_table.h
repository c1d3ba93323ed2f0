#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/registration/pair_registration.h"
#include "core/table_files/read_columns.h"
#include "core/vision/triangulation.h"

namespace capstan::registration {

/// The marker's pixels in one pair of images [px], with their standard deviations per axis.
struct StereoPixels {
  Eigen::Vector2d left, right;
  double left_sigma = 1.0, right_sigma = 1.0;
};

/// One row of a table: the tip in the base frame and the marker as the cameras see it. An empty cell leaves
/// its part out.
struct PairRow {
  std::optional<Eigen::Vector3d> base;    ///< [m]
  std::optional<Eigen::Vector3d> camera;  ///< in the left camera's frame [m]
  std::optional<StereoPixels> pixels;
};

/// Reads a table of any kind: the tip in the base frame as x, y, z [m], and the marker in the left camera's
/// frame as cam_x, cam_y, cam_z [m] or as left_u, left_v, right_u, right_v [px], with left_sigma and
/// right_sigma [px] where it has them. Other columns are ignored. With `poses`, x, y and z are those of this
/// table, row by row. Throws base::InputError for a missing or repeated column and for unequal numbers of
/// rows.
std::vector<PairRow> readPairTable(const std::filesystem::path& pairs,
                                   const std::filesystem::path& poses = {});

/// A table that is in memory, with its name for errors.
struct NamedColumns {
  std::string name;
  table_files::ColumnReader columns;
};
/// The same of such tables; `poses` is null where `pairs` has the poses too.
std::vector<PairRow> readPairTable(const NamedColumns& pairs, const NamedColumns* poses);

struct SkippedRow {
  std::size_t row = 0;
  std::string reason;
};

/// The rows that have both points.
struct PairPoints {
  std::vector<PointPair> pairs;
  std::vector<std::size_t> rows;  ///< row of each pair
  std::vector<SkippedRow> skipped;
};

/// Takes the points of the rows; those of pixels by `triangulator`, which rows with pixels need. Skips rows
/// without a value and rows whose rays do not meet in front of the cameras.
PairPoints pointsOf(const std::vector<PairRow>& rows,
                    const std::optional<vision::Triangulator>& triangulator);

/// The rows with the left and the right pixels exchanged.
std::vector<PairRow> exchanged(std::vector<PairRow> rows);

/// Whether left and right are exchanged in rows that do not register: the rays of most rows meet in the other
/// order, and in this order they do not, or only the other order registers.
bool areExchanged(const std::vector<PairRow>& rows, const vision::Triangulator& triangulator);

}  // namespace capstan::registration
