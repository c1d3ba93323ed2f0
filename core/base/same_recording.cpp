#include "core/base/same_recording.h"

#include "core/base/checksum.h"
#include "core/base/error.h"

namespace capstan::base {

namespace fs = std::filesystem;

bool sameRecording(const fs::path& a, const fs::path& b) {
  std::error_code fault;
  if (fs::equivalent(a, b, fault)) return true;
  if (!fs::is_regular_file(a, fault) || !fs::is_regular_file(b, fault)) return false;
  const auto size = fs::file_size(a, fault);
  if (fault || size != fs::file_size(b, fault) || fault) return false;
  try {
    return base::checksumOfFile(a) == base::checksumOfFile(b);
  } catch (const base::InputError&) {
    return false;
  }
}

}  // namespace capstan::base
