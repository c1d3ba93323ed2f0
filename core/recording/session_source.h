#pragma once

#include <filesystem>
#include <memory>

#include "core/tracking/source.h"

namespace capstan::recording {

/// Replays a session file in its recorded order of arrival, with bit-identical samples.
class SessionSource : public tracking::Source {
 public:
  /// Throws base::InputError for a file that is missing, not a session, damaged or of a newer version.
  explicit SessionSource(const std::filesystem::path& path);
  ~SessionSource() override;

  const tracking::SourceInfo& info() const override;
  /// Throws base::InputError if the file is damaged.
  bool next(tracking::Sample& out) override;
  /// Blocks cameras: frames are covered completely by an opaque occluder, tip samples have no position.
  void block(bool left, bool right) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::recording
