#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace capstan::recording {

/// Bounded queue between one producer thread and one consumer thread. Slots are created once and reused.
/// Neither side waits or allocates.
template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t capacity) : slots_(slotsFor(capacity)) {}
  /// Number of slots that prepare() visits: one is always empty.
  static constexpr std::size_t slotsFor(std::size_t capacity) { return capacity + 1; }

  /// Producer: slot to fill, or null when the ring is full. push() passes it to the consumer.
  T* back() {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return after(tail) == head_.load(std::memory_order_acquire) ? nullptr : &slots_[tail];
  }
  void push() { tail_.store(after(tail_.load(std::memory_order_relaxed)), std::memory_order_release); }

  /// Consumer: oldest slot, or null when the ring is empty. pop() releases it.
  T* front() {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    return head == tail_.load(std::memory_order_acquire) ? nullptr : &slots_[head];
  }
  void pop() { head_.store(after(head_.load(std::memory_order_relaxed)), std::memory_order_release); }

  /// Prepares every slot before or after use, on one thread.
  template <class Prepare>
  void prepare(Prepare&& each) {
    for (T& slot : slots_) each(slot);
  }

 private:
  std::size_t after(std::size_t index) const { return index + 1 == slots_.size() ? 0 : index + 1; }

  std::vector<T> slots_;
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace capstan::recording
