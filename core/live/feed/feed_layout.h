#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/live/feed/feed_state.h"

/// Layout of the shared memory: a page with FeedHeader, then kFeedSlots slots. A slot is FeedSlot, rounded up
/// to pages, then room for two images. The writer fills the slots in turn.
///
/// A slot's sequence is 2n − 1 while the writer fills in state n, and 2n afterwards. A reader copies a slot
/// and uses the copy only if the sequence was 2n before and after. Every word is stored with release and
/// loaded with acquire: a reader that has got a word of a later state then also finds the later sequence
/// (H.-J. Boehm, Can seqlocks get along with programming language memory models?, MSPC 2012).
namespace capstan::live {

inline constexpr std::uint64_t kFeedMagic = 0x6465'6546'7370'6143;  ///< "CapsFeed" in memory
inline constexpr std::uint32_t kFeedVersion = 1;
inline constexpr std::uint32_t kFeedSlots = 3;

struct FeedHeader {
  std::uint64_t magic;  ///< written last, so that a reader sees a whole header
  std::uint32_t version;
  std::uint32_t slot_count;
  std::uint64_t state_bytes;  ///< sizeof(FeedState)
  std::uint64_t total_bytes;  ///< kFeedBytes
  std::int64_t writer;        ///< process
  std::int64_t heartbeat_ns;  ///< steady clock, every kFeedBeat while the writer lives [ns]
  std::uint64_t newest;       ///< number of the newest whole state; 0: none yet
  std::int64_t run;           ///< FeedRun
};
static_assert(sizeof(FeedHeader) == 64);

struct FeedSlot {
  std::uint64_t sequence;
  FeedState state;
};

inline constexpr std::size_t kFeedPage = 4096;
constexpr std::size_t wholePages(std::size_t bytes) {
  return (bytes + kFeedPage - 1) / kFeedPage * kFeedPage;
}

inline constexpr std::size_t kFeedImageBytes = wholePages(std::size_t{3} * kFeedWidth * kFeedHeight);
inline constexpr std::size_t kFeedSlotBytes = wholePages(sizeof(FeedSlot)) + 2 * kFeedImageBytes;
inline constexpr std::size_t kFeedBytes = kFeedPage + kFeedSlots * kFeedSlotBytes;

constexpr std::size_t slotOffset(std::uint64_t number) {
  return kFeedPage + static_cast<std::size_t>(number % kFeedSlots) * kFeedSlotBytes;
}
constexpr std::size_t imageOffset(std::uint64_t number, std::size_t eye) {
  return slotOffset(number) + wholePages(sizeof(FeedSlot)) + eye * kFeedImageBytes;
}

/// A word of the shared memory as an atomic one. The memory of a reader is mapped for reading, and only
/// loaded.
template <class Word>
std::atomic_ref<Word> shared(const Word& word) {
  static_assert(std::atomic_ref<Word>::is_always_lock_free);
  return std::atomic_ref<Word>(const_cast<Word&>(word));
}

/// Copies into shared memory; `to` is aligned to 8 bytes and has room up to the next multiple of 8.
inline void storeWords(std::byte* to, const void* from, std::size_t bytes) {
  const auto* source = static_cast<const std::byte*>(from);
  for (std::size_t i = 0; i < bytes; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, source + i, i + 8 <= bytes ? 8 : bytes - i);
    shared(*reinterpret_cast<std::uint64_t*>(to + i)).store(word, std::memory_order_release);
  }
}

/// Copies out of shared memory; `from` is aligned to 8 bytes and readable up to the next multiple of 8.
inline void loadWords(void* to, const std::byte* from, std::size_t bytes) {
  auto* target = static_cast<std::byte*>(to);
  for (std::size_t i = 0; i < bytes; i += 8) {
    const std::uint64_t word =
        shared(*reinterpret_cast<const std::uint64_t*>(from + i)).load(std::memory_order_acquire);
    std::memcpy(target + i, &word, i + 8 <= bytes ? 8 : bytes - i);
  }
}

}  // namespace capstan::live
