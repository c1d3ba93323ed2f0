#pragma once

#include <filesystem>

namespace capstan::base {

/// Temporary file beside its target; commit() moves it onto the target once it is complete. The old target
/// stays until then, and no partial file remains after a failure or a cancellation. Behind a symbolic link
/// the file is replaced and the link stays. A device or pipe is written directly.
class PartFile {
 public:
  /// Names the temporary file `<target>.part`.
  explicit PartFile(const std::filesystem::path& target);
  /// Names the temporary file `<stem>.part<suffix>`, for writers that choose the format by the suffix.
  enum class Keep { kSuffix };
  PartFile(const std::filesystem::path& target, Keep);
  /// Removes the temporary file, and the journal files that SQLite leaves beside it.
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& path() const { return part_; }
  /// Path of the target after every symbolic link was followed.
  const std::filesystem::path& target() const { return target_; }
  /// Replaces the target by the temporary file, which must be closed. When the target is a folder or cannot
  /// be replaced, removes the temporary file and throws base::InputError.
  void commit();

 private:
  void begin();

  std::filesystem::path target_, part_;
  bool direct_ = false, committed_ = false;
};

/// Throws base::InputError when `target` cannot be written: it is a folder, or its folder does not exist or
/// does not allow new files. Changes nothing on the disk.
void checkWritable(const std::filesystem::path& target);

}  // namespace capstan::base
