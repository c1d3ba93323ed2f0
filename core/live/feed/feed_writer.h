#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "core/live/feed/feed_layout.h"
#include "core/live/feed/feed_segment.h"
#include "core/live/feed/feed_state.h"

namespace capstan::live {

/// Publishes a session for monitors of the same user on this machine, in POSIX shared memory with permissions
/// 0600 (feed_layout.h). One writer, any number of readers; the writer never waits for them. The end of a
/// writer removes the name; what a killed writer left behind is replaced by the next one.
class FeedWriter {
 public:
  /// Creates the shared memory of feed `name`. Throws base::InputError if a running process feeds that name,
  /// or if the machine has no shared memory left.
  explicit FeedWriter(const std::string& name);
  ~FeedWriter();
  FeedWriter(const FeedWriter&) = delete;
  FeedWriter& operator=(const FeedWriter&) = delete;

  const std::string& name() const { return name_; }

  /// Publishes `state` and the images: 8-bit grey or BGR, or empty. Sets number, time of publication, and
  /// size and kind of the images in `state`. One thread at a time.
  void publish(FeedState& state, const cv::Mat& left, const cv::Mat& right);
  /// Publishes `state` without images: monitors keep showing the former ones.
  void publish(FeedState& state);
  /// Any thread.
  void setRun(FeedRun run);

 private:
  void begin();
  void write(FeedState& state);
  FeedImage store(const cv::Mat& image, std::size_t eye, FeedEye& out);
  void beat(const std::stop_token& stop);

  const std::string name_, segment_name_;
  FeedSegment segment_;
  std::uint64_t number_ = 0;
  std::array<std::size_t, 2 * kFeedSlots> reserved_{};  ///< bytes, per slot and eye
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread heart_;
};

}  // namespace capstan::live
