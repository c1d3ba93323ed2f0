#include "core/live/feed/feed_reader.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>

#include "core/live/feed/feed_clock.h"
#include "core/live/feed/feed_layout.h"

namespace capstan::live {

namespace {

constexpr std::int64_t kLookPeriod = 50'000'000;  // between looks for another session [ns]
constexpr std::int64_t kSilence = std::chrono::nanoseconds(kFeedSilence).count();

/// The header's words that do not change.
FeedHeader headerOf(const FeedSegment& segment) {
  FeedHeader header{};
  loadWords(&header, segment.at(0), sizeof header);
  return header;
}

}  // namespace

FeedReader::FeedReader(const std::string& name) : segment_name_(segmentName(name)) {}

FeedRun FeedReader::run() const {
  if (!segment_ || link_ == Link::kEnded) return FeedRun::kEnded;
  const auto run = shared(segment_.as<FeedHeader>(0).run).load(std::memory_order_acquire);
  return run == static_cast<std::int64_t>(FeedRun::kPaused)  ? FeedRun::kPaused
         : run == static_cast<std::int64_t>(FeedRun::kEnded) ? FeedRun::kEnded
                                                             : FeedRun::kRunning;
}

bool FeedReader::read(FeedFrame& out, std::int64_t now_ns) {
  if (link_ != Link::kLive || dead(now_ns)) follow(now_ns);
  if (link_ != Link::kLive) return false;
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts && link_ == Link::kLive; ++attempt) {
    const auto number = shared(segment_.as<FeedHeader>(0).newest).load(std::memory_order_acquire);
    if (number == newest_) return false;
    if (copy(number, out)) {
      newest_ = number;
      return true;
    }
    ++overtaken_;
  }
  return false;
}

/// Looks for a session: the first one, the next one, or the same one once it is alive again.
void FeedReader::follow(std::int64_t now_ns) {
  if (link_ == Link::kLive) link_ = Link::kEnded;
  if (looked_ && now_ns - looked_ns_ < kLookPeriod) return;
  looked_ = true;
  looked_ns_ = now_ns;
  if (open()) newest_ = 0;
  if (segment_ && link_ != Link::kRefused && !dead(now_ns)) link_ = Link::kLive;
}

/// Maps the segment that has the name now, if it is not the mapped one. False: none, or nothing new.
bool FeedReader::open() {
  const int descriptor = shm_open(segment_name_.c_str(), O_RDONLY | O_CLOEXEC, 0);
  if (descriptor < 0) {
    if (link_ == Link::kRefused) link_ = Link::kWaiting;
    return false;
  }
  struct stat status {};
  const bool known = fstat(descriptor, &status) == 0 && segment_ && status.st_ino == inode_;
  if (known || status.st_size == 0) {  // a writer is about to fill it in
    close(descriptor);
    return false;
  }
  if (status.st_uid != geteuid() || static_cast<std::size_t>(status.st_size) != kFeedBytes) {
    close(descriptor);
    refuse(status.st_uid != geteuid()
               ? "the shared memory belongs to another user"
               : "the shared memory has another size: another version of Capstan wrote it");
    return false;
  }
  FeedSegment segment(descriptor, false);
  if (!segment || headerOf(segment).magic == 0) return false;
  if (const std::string fault = faultOf(segment); !fault.empty()) {
    refuse(fault);
    return false;
  }
  segment_ = std::move(segment);
  inode_ = status.st_ino;
  ++feeds_;
  link_ = Link::kWaiting;
  fault_.clear();
  return true;
}

std::string FeedReader::faultOf(const FeedSegment& segment) const {
  const FeedHeader header = headerOf(segment);
  if (header.magic != kFeedMagic) return "the shared memory is not Capstan's";
  if (header.version != kFeedVersion)
    return "the session is of another version of Capstan: feed version " + std::to_string(header.version) +
           ", this monitor reads " + std::to_string(kFeedVersion);
  if (header.slot_count != kFeedSlots || header.state_bytes != sizeof(FeedState) ||
      header.total_bytes != kFeedBytes)
    return "the shared memory has another layout: another version of Capstan wrote it";
  return {};
}

void FeedReader::refuse(const std::string& why) {
  segment_ = {};
  inode_ = 0;
  link_ = Link::kRefused;
  fault_ = why;
}

/// True: no heartbeat for long. A writer that ends sets its heartbeat to zero.
bool FeedReader::dead(std::int64_t now_ns) const {
  return now_ns - shared(segment_.as<FeedHeader>(0).heartbeat_ns).load(std::memory_order_acquire) > kSilence;
}

bool FeedReader::copy(std::uint64_t number, FeedFrame& out) {
  const std::size_t offset = slotOffset(number);
  const auto sequence = shared(segment_.as<FeedSlot>(offset).sequence);
  if (sequence.load(std::memory_order_acquire) != 2 * number) return false;
  loadWords(&state_, segment_.at(offset + offsetof(FeedSlot, state)), sizeof state_);
  if (sequence.load(std::memory_order_acquire) != 2 * number) return false;
  if (state_.number != number || !makeSafe(state_)) {
    refuse("the session sends unreadable data");
    return false;
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const FeedEye& seen = state_.eyes[eye];
    cv::Mat& image = out.images[eye];
    if (seen.image != FeedImage::kShown) {
      image.release();
      continue;
    }
    image.create(seen.height, seen.width, CV_8UC(seen.channels));
    loadWords(image.data, segment_.at(imageOffset(number, eye)), imageBytes(seen));
  }
  if (sequence.load(std::memory_order_acquire) != 2 * number) return false;
  out.state = state_;
  return true;
}

}  // namespace capstan::live
