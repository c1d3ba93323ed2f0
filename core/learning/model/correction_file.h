#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// What a model was learned from.
struct CorrectionSource {
  std::vector<std::string> files, checksums;  ///< tables of tip poses, base::checksumOfFile
  learning::StreamKind towards = learning::StreamKind::kCommand;  ///< what corrected poses are asked of
  double clock_offset = 0.0;                                      ///< of observations behind commands [s]
  std::size_t states = 0, rejected = 0;                           ///< learned from, and cleaned away
  std::string software;                                           ///< that learned it

  bool operator==(const CorrectionSource&) const = default;
};

/// A model with where it comes from.
///
/// A file is a line "capstan correction 3", a line of JSON (what the model is made of, its source, kernels,
/// how many numbers follow and their checksum), and these numbers as 64-bit floating point, least byte first:
/// offset, features' middle turn, lever, workspace, turns, middles, deviations, scales, inflations, then of
/// each member of each group the kernel's logarithms, inducing points, the lower triangle of B and the sums,
/// each by columns.
struct CorrectionFile {
  learning::CorrectionModel model;
  CorrectionSource source;
};

/// base::InputError: cannot be written; what stood there stays.
void writeCorrection(const CorrectionFile& file, const std::filesystem::path& path);

/// base::InputError naming the file and a remedy: not there, no such file, of another version, cut short or
/// damaged.
CorrectionFile readCorrection(const std::filesystem::path& path);

}  // namespace capstan::learning
