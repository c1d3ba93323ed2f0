#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// Source of a model's training data.
struct CorrectionSource {
  std::vector<std::string> files, checksums;  ///< tables of tip poses, base::checksumOfFile
  learning::StreamKind towards = learning::StreamKind::kCommand;  ///< stream of the corrected poses
  double clock_offset = 0.0;             ///< delay of observations behind commands [s]
  std::size_t states = 0, rejected = 0;  ///< number of training states, and of rejected ones
  std::string software;                  ///< name and version that learned it

  bool operator==(const CorrectionSource&) const = default;
};

/// A model and the source of its training data.
///
/// File format: a line "capstan correction 3", a line of JSON (structure of the model, its source, kernels,
/// count and checksum of the numbers), and the numbers as 64-bit floating point, little-endian. Their order
/// is: offset, mean rotation of the features, lever, workspace, rotations, means, deviations, scales,
/// inflations. For each member of each group follow the kernel's logarithms, inducing points, the lower
/// triangle of B and the sums, each by columns.
struct CorrectionFile {
  learning::CorrectionModel model;
  CorrectionSource source;
};

/// Writes the file. Throws base::InputError if it cannot be written; an existing file then stays.
void writeCorrection(const CorrectionFile& file, const std::filesystem::path& path);

/// Reads the file. Throws base::InputError naming the file and a remedy if it is missing, not a correction
/// file, of another version, truncated or damaged.
CorrectionFile readCorrection(const std::filesystem::path& path);

}  // namespace capstan::learning
