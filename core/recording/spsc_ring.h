#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace capstan::recording {

/// Bounded queue between one producer and one consumer thread. Slots are made once and reused; neither side
/// waits, neither allocates.
template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t capacity) : slots_(capacity + 1) {}

  /// Producer: the slot to fill, or null when the ring is full. push() hands it over.
  T* back() {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return after(tail) == head_.load(std::memory_order_acquire) ? nullptr : &slots_[tail];
  }
  void push() { tail_.store(after(tail_.load(std::memory_order_relaxed)), std::memory_order_release); }

  /// Consumer: the oldest, or null when the ring is empty. pop() gives its slot back.
  T* front() {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    return head == tail_.load(std::memory_order_acquire) ? nullptr : &slots_[head];
  }
  void pop() { head_.store(after(head_.load(std::memory_order_relaxed)), std::memory_order_release); }

  /// Before use, by one thread: prepares every slot.
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
