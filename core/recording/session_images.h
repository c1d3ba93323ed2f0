#pragma once

#include <filesystem>
#include <memory>

#include "core/tracking/sample.h"

namespace capstan::recording {

/// Pairs of images of a session in any order, by their time. The file may be under recording.
class SessionImages {
 public:
  /// Throws base::InputError as SessionSource.
  explicit SessionImages(const std::filesystem::path& path);
  ~SessionImages();

  /// Writes the pair whose exposure is nearest to t [s] to `out`. False: the session has no images, or none
  /// within `reach` [s] of t. Throws base::InputError for a damaged image.
  bool at(double t, double reach, tracking::StereoFrame& out);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::recording
