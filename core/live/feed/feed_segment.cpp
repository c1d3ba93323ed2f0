#include "core/live/feed/feed_segment.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/live/feed/feed_layout.h"

namespace capstan::live {

std::string segmentName(const std::string& name) {
  constexpr std::size_t kLongest = 40;
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  if (name.empty() || name.size() > kLongest || !std::all_of(name.begin(), name.end(), good))
    throw base::InputError(
        {{}, 0, "name of the monitor feed", name, "is not a name", "Use 1 to 40 letters, digits, - or _"});
  return "/capstan-" + std::to_string(geteuid()) + "-" + name;
}

FeedSegment::FeedSegment(int descriptor, bool writable) : descriptor_(descriptor) {
  void* memory =
      mmap(nullptr, kFeedBytes, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, descriptor, 0);
  if (memory != MAP_FAILED) memory_ = static_cast<std::byte*>(memory);
}

FeedSegment::FeedSegment(FeedSegment&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), memory_(std::exchange(other.memory_, nullptr)) {}

FeedSegment& FeedSegment::operator=(FeedSegment&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(memory_, other.memory_);
  return *this;
}

FeedSegment::~FeedSegment() {
  if (memory_) munmap(memory_, kFeedBytes);
  if (descriptor_ >= 0) close(descriptor_);
}

bool FeedSegment::reserve(std::size_t offset, std::size_t bytes) const {
  return posix_fallocate(descriptor_, static_cast<off_t>(offset), static_cast<off_t>(bytes)) == 0;
}

}  // namespace capstan::live
