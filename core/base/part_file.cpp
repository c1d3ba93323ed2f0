#include "core/base/part_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "core/base/error.h"

namespace capstan::base {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(
      {path.string(), 0, {}, {}, reason, "Choose another name, or check the folder and its permissions"});
}

/// Path that `path` leads to after every symbolic link was followed; no file needs to exist there.
fs::path behindLinks(fs::path path) {
  constexpr int kMostLinks = 40;  // as Linux
  std::error_code fault;
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, fault); ++links) {
    const fs::path next = fs::read_symlink(path, fault);
    if (fault) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

/// Whether `path` is a device, a pipe or a socket, which a file must not replace.
bool isNode(const fs::path& path) {
  std::error_code fault;
  const fs::file_status status = fs::status(path, fault);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

}  // namespace

PartFile::PartFile(const fs::path& target) : target_(behindLinks(target)), part_(target_.string() + ".part") {
  begin();
}

PartFile::PartFile(const fs::path& target, Keep)
    : target_(behindLinks(target)),
      part_(target_.parent_path() / (target_.stem().string() + ".part" + target_.extension().string())) {
  begin();
}

void PartFile::begin() {
  direct_ = isNode(target_);
  std::error_code fault;
  if (direct_)
    part_ = target_;
  else
    fs::remove(part_, fault);  // a file that stays in the way causes an error when the part is opened
}

PartFile::~PartFile() {
  if (direct_) return;
  std::error_code fault;
  if (!committed_) fs::remove(part_, fault);
  for (const char* suffix : {"-journal", "-wal", "-shm"}) fs::remove(part_.string() + suffix, fault);
}

void PartFile::commit() {
  if (direct_) return;
  std::error_code fault;
  fs::rename(part_, target_, fault);
  if (fault) refuse(target_, "cannot be written: " + fault.message());
  committed_ = true;
}

void checkWritable(const fs::path& target) {
  std::error_code fault;
  if (fs::is_directory(target, fault)) refuse(target, "is a folder");
  if (isNode(target)) return;
  const fs::path file = behindLinks(target);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, fault)) refuse(target, "cannot be written: its folder does not exist");
  std::string trial = file.string() + ".XXXXXX";  // permission bits say too little: mounts, root, full disks
  const int made = mkstemp(trial.data());
  if (made < 0) refuse(target, "cannot be written: " + std::generic_category().message(errno));
  close(made);
  fs::remove(trial, fault);
}

}  // namespace capstan::base
