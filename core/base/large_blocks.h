#pragma once

#include <malloc.h>

namespace capstan::base {

/// Gives the memory of large blocks, such as images, back to the system when they are freed. Without this
/// call, glibc raises its limit for such blocks to the largest one that was freed, and images of former
/// sessions leave holes: the window grew by 86 MB over 25 sessions. For the beginning of main().
inline void returnLargeBlocks() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLarge = 256 << 10;  // [bytes]; an image of 640 × 480 has 900 KiB
  ::mallopt(M_MMAP_THRESHOLD, kLarge);
#endif
}

}  // namespace capstan::base
