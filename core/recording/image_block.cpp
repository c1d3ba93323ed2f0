#include "core/recording/image_block.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/recording/disk_space.h"

namespace capstan::recording {

std::unique_ptr<ImageBlock> makeImageBlock(const std::filesystem::path& session, std::size_t bytes) {
  try {
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
