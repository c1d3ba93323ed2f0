#pragma once

#include <filesystem>
#include <memory>

#include "core/tracking/source.h"

namespace capstan::recording {

/// Replays a session file in the order of arrival that it was recorded in, to the last bit.
class SessionSource : public tracking::Source {
 public:
  /// Throws base::InputError for a file that is missing, foreign, damaged or of a newer version.
  explicit SessionSource(const std::filesystem::path& path);
  ~SessionSource() override;

  const tracking::SourceInfo& info() const override;
  /// Throws base::InputError where the file is damaged.
  bool next(tracking::Sample& out) override;
  /// Frames: an opaque occluder is painted over the whole image. Tip samples: no position.
  void block(bool left, bool right) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::recording
