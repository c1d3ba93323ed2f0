#pragma once

#include <filesystem>

namespace capstan::base {

/// A file that is written beside its place and moved there when it is whole: whatever stood there stays until
/// then, and nothing half written remains after a failure or a cancellation. Behind a symbolic link the file
/// it points to is replaced, the link stays. A device or pipe is written directly.
class PartFile {
 public:
  /// Writes go to `<target>.part`.
  explicit PartFile(const std::filesystem::path& target);
  /// Writes go beside `target`: to `<stem>.part<suffix>`, for writers that go by the suffix.
  enum class Keep { kSuffix };
  PartFile(const std::filesystem::path& target, Keep);
  /// Removes the part and what SQLite leaves beside one.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& path() const { return part_; }
  /// The file itself, behind every link.
  const std::filesystem::path& target() const { return target_; }
  /// Replaces the target. The part must be closed. Throws base::InputError, the part removed, when the target
  /// is a folder or cannot be replaced.
  void commit();

 private:
  void begin();

  std::filesystem::path target_, part_;
  bool direct_ = false, committed_ = false;
};

/// Throws base::InputError where `target` cannot be written: a folder stands there, its folder does not exist
/// or takes no files. Leaves everything as it was.
void checkWritable(const std::filesystem::path& target);

}  // namespace capstan::base
