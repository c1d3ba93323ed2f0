#pragma once

#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

namespace capstan {

/// File system of a few megabytes: a tmpfs that is visible only to this thread and to threads and processes
/// that it starts later. If it cannot be mounted, why() gives the reason, and tests are skipped.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t megabytes) {
    std::string name = (std::filesystem::temp_directory_path() / "capstan-disk-XXXXXX").string();
    path_ = mkdtemp(name.data());
    const std::string size = "size=" + std::to_string(megabytes) + "m";
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("capstan", path_.c_str(), "tmpfs", 0, size.c_str()) != 0)
      why_ = std::string("no small disk can be mounted here: ") + std::strerror(errno);
  }
  ~SmallDisk() {
    if (why_.empty()) umount2(path_.c_str(), MNT_DETACH);
    std::error_code fault;
    std::filesystem::remove(path_, fault);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return why_.empty(); }
  const std::string& why() const { return why_; }
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::size_t freeBytes() const { return std::filesystem::space(path_).available; }
  /// Makes the disk read-only; returns false on failure.
  bool makeReadOnly() const {
    return mount("capstan", path_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }

 private:
  std::filesystem::path path_;
  std::string why_;
};

}  // namespace capstan
