#pragma once

#include <cstddef>
#include <string>

namespace capstan::live {

/// Name of the first session's feed of a user.
inline constexpr const char* kFeedName = "capstan";

/// Name of the shared memory of feed `name` of the present user: "/capstan-UID-NAME". Throws base::InputError
/// if `name` is not 1 to 40 letters, digits, "-" or "_".
std::string segmentName(const std::string& name);

/// Shared memory of one feed, mapped into this process, with its descriptor.
class FeedSegment {
 public:
  FeedSegment() = default;
  /// Maps kFeedBytes of `descriptor`, which it owns from now on.
  FeedSegment(int descriptor, bool writable);
  FeedSegment(FeedSegment&& other) noexcept;
  FeedSegment& operator=(FeedSegment&& other) noexcept;
  ~FeedSegment();

  explicit operator bool() const { return memory_ != nullptr; }
  std::byte* at(std::size_t offset) const { return memory_ + offset; }
  template <class T>
  T& as(std::size_t offset) const {
    return *reinterpret_cast<T*>(memory_ + offset);
  }
  int descriptor() const { return descriptor_; }
  /// Takes memory of the machine for a part of the segment. False: there is none left.
  bool reserve(std::size_t offset, std::size_t bytes) const;

 private:
  int descriptor_ = -1;
  std::byte* memory_ = nullptr;
};

}  // namespace capstan::live
