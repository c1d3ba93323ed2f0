#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "core/live/feed/feed_segment.h"
#include "core/live/feed/feed_state.h"

namespace capstan::live {

/// Receives what a FeedWriter of the same name and user publishes, from its own process. Holds no locks and
/// writes nothing, so a reader that is stopped or killed does not disturb the session. Follows the name from
/// one session to the next. Everything that is read is checked (makeSafe).
class FeedReader {
 public:
  enum class Link {
    kWaiting,  ///< no session yet
    kRefused,  ///< the shared memory is not a feed of this version: fault()
    kLive,     ///< a session runs
    kEnded     ///< the session has ended, or its process is dead
  };

  /// Throws base::InputError for a bad name (segmentName).
  explicit FeedReader(const std::string& name);

  /// Looks for news at `now_ns` (feedNow); waits for nothing. True: `out` has the newest state, which was not
  /// read before, and its images; images of `out` are reused.
  bool read(FeedFrame& out, std::int64_t now_ns);

  Link link() const { return link_; }
  /// Of the live session, or of the last one.
  FeedRun run() const;
  /// Reason of kRefused.
  const std::string& fault() const { return fault_; }
  /// Number of feeds that had the name so far, one after another.
  std::uint64_t feeds() const { return feeds_; }
  /// Number of times that a copy was given up because the writer was filling the same slot again.
  std::uint64_t overtaken() const { return overtaken_; }

 private:
  void follow(std::int64_t now_ns);
  bool open();
  std::string faultOf(const FeedSegment& segment) const;
  bool dead(std::int64_t now_ns) const;
  bool copy(std::uint64_t number, FeedFrame& out);
  void refuse(const std::string& why);

  const std::string segment_name_;
  FeedSegment segment_;
  ino_t inode_ = 0;
  Link link_ = Link::kWaiting;
  std::string fault_;
  std::int64_t looked_ns_ = 0;
  bool looked_ = false;
  std::uint64_t newest_ = 0, feeds_ = 0, overtaken_ = 0;
  FeedState state_;
};

}  // namespace capstan::live
