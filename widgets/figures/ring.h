#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/check.h"

namespace capstan::widgets {

/// Ring buffer of the newest `capacity` items, in memory that is allocated once. Index 0 is the oldest item.
template <class T>
class Ring {
 public:
  explicit Ring(std::size_t capacity) : items_(capacity) { CAPSTAN_CHECK(capacity > 0); }

  void push(const T& item) {
    items_[static_cast<std::size_t>(pushed_ % items_.size())] = item;
    ++pushed_;
  }
  void clear() { pushed_ = 0; }

  std::size_t size() const {
    return pushed_ < items_.size() ? static_cast<std::size_t>(pushed_) : items_.size();
  }
  bool empty() const { return pushed_ == 0; }
  std::size_t capacity() const { return items_.size(); }
  /// Number of items pushed so far; item i was the (pushed() − size() + i)-th.
  std::uint64_t pushed() const { return pushed_; }

  const T& operator[](std::size_t i) const { return items_[slot(i)]; }
  T& operator[](std::size_t i) { return items_[slot(i)]; }
  const T& back() const { return (*this)[size() - 1]; }
  T& back() { return (*this)[size() - 1]; }

  /// Index of the first item for which `below` is false. Items must be partitioned by it, for example ordered
  /// by time.
  template <class Predicate>
  std::size_t partitionPoint(Predicate below) const {
    std::size_t low = 0, high = size();
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (below((*this)[middle]))
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

 private:
  std::size_t slot(std::size_t i) const {
    CAPSTAN_ASSERT(i < size());
    return static_cast<std::size_t>((pushed_ - size() + i) % items_.size());
  }

  std::vector<T> items_;
  std::uint64_t pushed_ = 0;
};

}  // namespace capstan::widgets
