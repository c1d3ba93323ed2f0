#include "core/live/feed/feed_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/live/feed/feed_clock.h"
#include "core/live/feed/feed_layout.h"

namespace capstan::live {

namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& reason, const std::string& remedy) {
  throw base::InputError({{}, 0, "monitor feed", name, reason, remedy});
}

/// Whether `segment` is still the name of the open file.
bool stillNamed(const std::string& segment, const struct stat& open) {
  const int now = shm_open(segment.c_str(), O_RDONLY, 0);
  if (now < 0) return false;
  struct stat named {};
  const bool same = fstat(now, &named) == 0 && named.st_ino == open.st_ino && named.st_dev == open.st_dev;
  close(now);
  return same;
}

/// Descriptor of a new segment of this process, empty and locked. The lock ends with the process, however
/// that ends. Only who holds the lock of the segment that has the name fills it in or removes it, so that two
/// writers never share one.
int createSegment(const std::string& name, const std::string& segment) {
  constexpr int kAttempts = 16;  // another writer may begin at the same moment
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const int descriptor = shm_open(segment.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0)
      refuse(name, std::string("shared memory cannot be opened: ") + std::strerror(errno),
             "Choose another name");
    struct stat status {};
    const bool own = fstat(descriptor, &status) == 0 && status.st_uid == geteuid();
    const bool locked = own && flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (locked && stillNamed(segment, status)) {
      if (status.st_size == 0 && fchmod(descriptor, 0600) == 0) return descriptor;
      shm_unlink(segment.c_str());  // left by a writer that was killed
    }
    close(descriptor);
    if (!own) refuse(name, "belongs to another user", "Choose another name");
    if (!locked)
      refuse(name, "another running session uses this name", "End that session or choose another name");
  }
  refuse(name, "other sessions begin at the same moment", "Try again");
}

}  // namespace

FeedWriter::FeedWriter(const std::string& name) : name_(name), segment_name_(segmentName(name)) {
  const int descriptor = createSegment(name_, segment_name_);
  const bool sized = ftruncate(descriptor, static_cast<off_t>(kFeedBytes)) == 0;
  segment_ = FeedSegment(descriptor, true);
  bool room = sized && segment_ && segment_.reserve(0, kFeedPage);
  for (std::uint64_t slot = 0; room && slot < kFeedSlots; ++slot)
    room = segment_.reserve(slotOffset(slot), sizeof(FeedSlot));
  if (!room) {
    shm_unlink(segment_name_.c_str());
    refuse(name_, "the machine has no shared memory left", "Free some in /dev/shm");
  }
  begin();
  heart_ = std::jthread([this](const std::stop_token& stop) { beat(stop); });
}

FeedWriter::~FeedWriter() {
  heart_.request_stop();
  heart_.join();
  setRun(FeedRun::kEnded);
  shared(segment_.as<FeedHeader>(0).heartbeat_ns).store(0, std::memory_order_release);
  shm_unlink(segment_name_.c_str());
}

void FeedWriter::begin() {
  auto& header = segment_.as<FeedHeader>(0);
  header.version = kFeedVersion;
  header.slot_count = kFeedSlots;
  header.state_bytes = sizeof(FeedState);
  header.total_bytes = kFeedBytes;
  header.writer = getpid();
  shared(header.run).store(static_cast<std::int64_t>(FeedRun::kRunning), std::memory_order_relaxed);
  shared(header.heartbeat_ns).store(feedNow(), std::memory_order_relaxed);
  shared(header.magic).store(kFeedMagic, std::memory_order_release);
}

void FeedWriter::beat(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    shared(segment_.as<FeedHeader>(0).heartbeat_ns).store(feedNow(), std::memory_order_release);
    wake_.wait_for(lock, stop, kFeedBeat, [] { return false; });
  }
}

void FeedWriter::setRun(FeedRun run) {
  shared(segment_.as<FeedHeader>(0).run).store(static_cast<std::int64_t>(run), std::memory_order_release);
}

FeedImage FeedWriter::store(const cv::Mat& image, std::size_t eye, FeedEye& out) {
  out.width = out.height = out.channels = 0;
  if (image.empty()) return FeedImage::kNone;
  if (image.dims != 2 || (image.type() != CV_8UC1 && image.type() != CV_8UC3)) return FeedImage::kFormat;
  if (image.cols > kFeedWidth || image.rows > kFeedHeight) return FeedImage::kTooLarge;
  const std::size_t row = static_cast<std::size_t>(image.cols) * image.elemSize();
  const std::size_t bytes = row * static_cast<std::size_t>(image.rows);
  const std::size_t begin = imageOffset(number_, eye);
  std::size_t& reserved = reserved_[2 * (number_ % kFeedSlots) + eye];
  if (bytes > reserved) {
    if (!segment_.reserve(begin, wholePages(bytes))) return FeedImage::kNoMemory;
    reserved = wholePages(bytes);
  }
  out.width = image.cols;
  out.height = image.rows;
  out.channels = image.channels();
  const cv::Mat whole = image.isContinuous() ? image : image.clone();
  storeWords(segment_.at(begin), whole.data, bytes);
  return FeedImage::kShown;
}

void FeedWriter::publish(FeedState& state, const cv::Mat& left, const cv::Mat& right) {
  ++number_;
  shared(segment_.as<FeedSlot>(slotOffset(number_)).sequence)
      .store(2 * number_ - 1, std::memory_order_release);
  state.eyes[0].image = store(left, 0, state.eyes[0]);
  state.eyes[1].image = store(right, 1, state.eyes[1]);
  write(state);
}

void FeedWriter::publish(FeedState& state) {
  ++number_;
  shared(segment_.as<FeedSlot>(slotOffset(number_)).sequence)
      .store(2 * number_ - 1, std::memory_order_release);
  for (FeedEye& eye : state.eyes) eye.image = FeedImage::kUnchanged;
  write(state);
}

void FeedWriter::write(FeedState& state) {
  state.number = number_;
  state.published_ns = feedNow();
  const std::size_t offset = slotOffset(number_);
  storeWords(segment_.at(offset + offsetof(FeedSlot, state)), &state, sizeof state);
  shared(segment_.as<FeedSlot>(offset).sequence).store(2 * number_, std::memory_order_release);
  shared(segment_.as<FeedHeader>(0).newest).store(number_, std::memory_order_release);
}

}  // namespace capstan::live
