#pragma once

#include <filesystem>

namespace capstan::base {

/// A file that is written beside its place and moved there when it is whole: whatever stood there stays until
/// then, and nothing half written remains after a failure or a cancellation.
class PartFile {
 public:
  /// Writes go to `<target>.part`.
  explicit PartFile(std::filesystem::path target);
  /// Writes go to `part`, in the same folder. What a former run left there is removed.
  PartFile(std::filesystem::path target, std::filesystem::path part);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::filesystem::path& path() const { return part_; }
  /// Replaces the target. The part must be closed. Throws base::InputError, the part removed, when the target
  /// is a folder or cannot be replaced.
  void commit();

 private:
  std::filesystem::path target_, part_;
};

}  // namespace capstan::base
