#include "core/recording/image_block.h"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/recording/disk_space.h"

namespace capstan::recording {
namespace {

/// Memory that the system can give without swapping [bytes]; no limit where it does not say.
std::uint64_t availableMemory() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  for (std::uint64_t kilobytes = 0; file >> key >> kilobytes;
       file.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (key == "MemAvailable:") return 1024 * kilobytes;
  return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::unique_ptr<ImageBlock> makeImageBlock(const std::filesystem::path& session, std::size_t bytes) {
  try {
    if (bytes > availableMemory()) throw std::bad_alloc();  // mmap() itself promises more than there is
    return std::make_unique<ImageBlock>(bytes);
  } catch (const std::bad_alloc&) {
    throw base::InputError(
        {session.string(),
         0,
         {},
         {},
         fmt::format("cannot be recorded: {} of memory for the images are not available", sizeText(bytes)),
         "Choose a smaller image size, or end other programs"});
  }
}

}  // namespace capstan::recording
