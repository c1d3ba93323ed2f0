#include "core/recording/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "core/recording/checkpointer.h"
#include "core/recording/disk_space.h"
#include "core/recording/image_block.h"
#include "core/recording/record_queue.h"
#include "core/recording/recorder_text.h"
#include "core/recording/recording_space.h"
#include "core/recording/session_writer.h"
#include "core/recording/spsc_ring.h"

namespace capstan::recording {
namespace {

using Clock = std::chrono::steady_clock;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

std::size_t frameSlots(const RecorderOptions& options) {
  return slots(options.frame_rate, std::max(2.0, options.buffered_time));
}

}  // namespace

class Recorder::Impl {
 public:
  Impl(const std::filesystem::path& path, const SessionHeader& header, const RecorderOptions& options)
      : path_(path),
        options_(options),
        interval_(std::clamp(options.commit_interval, 0.01, 0.2)),
        reserve_(checkedReserve(path, options)),
        images_(makeImageBlock(path, 2 * SpscRing<FrameSlot>::slotsFor(frameSlots(options)) *
                                         ImageBlock::bytesOf(options.width, options.height))),
        writer_(path, header, SessionWriter::Durability::kFast),
        records_(
            slots(3.0 * options.motor_rate + 4.0 * options.frame_rate, std::max(2.0, options.buffered_time))),
        frames_(frameSlots(options)),
        checkpointer_(path, logThreshold(path, options)) {
    frames_.prepare([&](FrameSlot& slot) {
      for (cv::Mat& image : slot.image) image = images_->take(options_.width, options_.height);
    });
    if (options.max_bytes > 0) {
      const auto page = static_cast<std::uint64_t>(writer_.database().number("PRAGMA page_size"));
      writer_.database().run(fmt::format("PRAGMA max_page_count = {}", options.max_bytes / page));
    }
    checkpointer_.watch(writer_.database());
    takeSpace(space());
    stats_.reserve_bytes = reserve_;
    thread_ = std::thread([this] { write(); });
  }

  ~Impl() { close(); }

  bool offer(const tracking::Sample& sample) {
    if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) return offerFrame(*frame);
    Record* slot = open();
    if (!slot) return false;
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) slot->row = *motor;
    if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) slot->row = *joint;
    if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) slot->row = *tip;
    return hand(*slot);
  }

  bool offer(const tracking::Snapshot& snapshot) {
    Record* slot = open();
    if (!slot) return false;
    slot->row = estimateOf(snapshot);
    return hand(*slot);
  }

  void note(SessionEvent event, std::optional<Eigen::Isometry3d> registration = {},
            std::optional<std::string> marker = {}) {
    const std::lock_guard lock(mutex_);
    if (stats_.state != RecorderState::kRecording || closing_) return;
    messages_.push_back({seq_.fetch_add(1), std::move(event), std::move(registration), std::move(marker)});
  }

  void close() {
    {
      const std::lock_guard lock(mutex_);
      if (closing_) return;
      closing_ = true;
    }
    recording_.store(false, std::memory_order_relaxed);  // an offer() that waits returns
    wake_.notify_all();
    thread_.join();
    discardQueued();
    checkpointer_.stop();
    if (!finished_) finish();
    frames_.prepare([](FrameSlot& slot) { slot.image = {}; });
    images_.reset();  // stats() may be asked for long after the end
    const std::lock_guard lock(mutex_);
    if (stats_.state == RecorderState::kRecording) stats_.state = RecorderState::kClosed;
    stats_.log_bytes = 0;
  }

  RecorderStats stats() const {
    const std::lock_guard lock(mutex_);
    RecorderStats now = stats_;
    now.queued = queued_.load(std::memory_order_relaxed);
    now.dropped = dropped_.load(std::memory_order_relaxed);
    now.dropped_frames = dropped_frames_.load(std::memory_order_relaxed);
    if (now.state != RecorderState::kRecording) now.lost = lostNow();
    return now;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  /// The next slot of `ring`; null: it is full, or recording has ended. Waits for it with options_.wait.
  template <class T>
  T* openIn(SpscRing<T>& ring) {
    constexpr std::chrono::milliseconds kPeriod{1};
    while (recording_.load(std::memory_order_relaxed)) {
      if (T* slot = ring.back(); slot || !options_.wait) return slot;
      std::this_thread::sleep_for(kPeriod);
    }
    return nullptr;
  }
  Record* open() {
    Record* slot = openIn(records_);
    if (!slot) dropped_.fetch_add(1, std::memory_order_relaxed);
    return slot;
  }

  bool hand(Record& slot) {
    slot.seq = seq_.fetch_add(1, std::memory_order_relaxed);
    slot.offered = Clock::now();
    queued_.fetch_add(1, std::memory_order_relaxed);  // before push(), so that written never exceeds queued
    records_.push();
    return true;
  }

  bool offerFrame(const tracking::StereoFrame& frame) {
    FrameSlot* images = openIn(frames_);
    Record* slot = images ? open() : nullptr;
    if (!slot) {
      if (!images) dropped_.fetch_add(1, std::memory_order_relaxed);
      dropped_frames_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    images->take(frame);
    frames_.push();
    slot->row = FrameMark{};
    return hand(*slot);
  }

  void write() {
    constexpr double kCheckInterval = 0.25;  // [s]
    Clock::time_point looked = Clock::now();
    for (bool last = false; !last || records_.front();) {
      {
        std::unique_lock lock(mutex_);
        last = wake_.wait_for(lock, std::chrono::duration<double>(cut_short_ ? 0.0 : interval_),
                              [&] { return closing_; });
      }
      if (!finished_)
        commitQueued();
      else
        discardQueued();
      if (!finished_ && secondsBetween(looked, Clock::now()) > kCheckInterval) {
        looked = Clock::now();
        checkDisk();
      }
    }
  }

  /// Writes one transaction: the queued rows, as long as encoding takes less than the commit interval.
  void commitQueued() {
    std::vector<Message> messages;
    {
      const std::lock_guard lock(mutex_);
      messages.swap(messages_);
    }
    if (!records_.front() && messages.empty()) return;
    const Clock::time_point begin = Clock::now();
    Clock::time_point oldest = begin;
    std::uint64_t rows = 0, pairs = 0;
    const auto giveUp = [&](const std::string& why, const std::string& advice) {
      writer_.rollback();
      fail("writing failed: " + why, advice, oldest);
    };
    try {
      writer_.begin();
      for (const Message& message : messages) {
        writer_.write(message.seq, message.event);
        if (message.registration) writer_.setRegistration(*message.registration);
        if (message.marker) writer_.setMarker(*message.marker);
      }
      cut_short_ = false;
      while (const Record* record = records_.front()) {
        oldest = std::min(oldest, record->offered);
        pairs += writeRow(*record);
        records_.pop();
        ++rows;
        cut_short_ = secondsBetween(begin, Clock::now()) > interval_;
        if (cut_short_) break;
      }
      if (options_.before_commit) options_.before_commit();
      const Clock::time_point committing = Clock::now();
      writer_.commit();
      account(rows, pairs, oldest, committing);
      checkpointer_.wake();
    } catch (const SqliteError& error) {
      giveUp(error.what(), adviceFor(error));
    } catch (const std::exception& error) {
      giveUp(error.what(), "Start a new recording");
    }
  }

  void finish() {
    try {
      writer_.finish();
    } catch (const SqliteError& error) {
      report(fmt::format("the file could not be closed: {}. {}. {}", error.what(), besideText(path_),
                         adviceFor(error)));
    }
  }

  /// Number of frames: 1 for a pair of images, else 0.
  std::uint64_t writeRow(const Record& record) {
    return std::visit(
        [&](const auto& row) -> std::uint64_t {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(row)>, FrameMark>) {
            writer_.write(record.seq, frames_.front()->view());
            frames_.pop();
            return 1;
          } else {
            writer_.write(record.seq, row);
            return 0;
          }
        },
        record.row);
  }

  void account(std::uint64_t rows, std::uint64_t pairs, Clock::time_point oldest,
               Clock::time_point committing) {
    const Clock::time_point now = Clock::now();
    const std::lock_guard lock(mutex_);
    stats_.written += rows;
    stats_.frames += pairs;
    stats_.bytes = writer_.rowBytes();
    stats_.log_bytes = checkpointer_.logBytes();
    stats_.worst_commit = std::max(stats_.worst_commit, secondsBetween(committing, now));
    stats_.worst_backlog = std::max(stats_.worst_backlog, secondsBetween(oldest, now));
    if (writer_.images() > 0)
      stats_.encode_time = writer_.encodeSeconds() / static_cast<double>(writer_.images());
  }

  /// After a fault. The rows count as lost.
  void discardQueued() {
    while (const Record* record = records_.front()) {
      if (std::holds_alternative<FrameMark>(record->row)) frames_.pop();
      records_.pop();
    }
  }

  void checkDisk() {
    std::error_code fault;
    const DiskSpace now = space();
    if (!std::filesystem::exists(path_, fault))
      return fail("the file was removed, or its folder is gone",
                  "What was recorded is lost. Check the folder and start a new recording", Clock::now());
    const bool known = now.size > 0;
    if (known && now.free < reserve_) return stopAtReserve();
    const std::lock_guard lock(mutex_);
    takeSpace(now);
    growth_.add(Clock::now(), writer_.fileBytes());
    if (known) stats_.time_left = growth_.timeToGrow(now.free - reserve_);
  }

  /// Stops recording; the queued rows use the reserve.
  void stopAtReserve() {
    recording_.store(false, std::memory_order_relaxed);
    while (!finished_ && records_.front()) commitQueued();
    if (!finished_)
      fail("recording stopped: on the disk only the reserve of " + sizeText(reserve_) + " is free",
           kFreeSpace, Clock::now());
  }

  /// Ends recording after a fault, on the writer's thread. Closes the file before the fault is reported, so
  /// that the message is true of the file. `oldest`: time of offer of the oldest row that is not in the file.
  void fail(const std::string& reason, const std::string& advice, Clock::time_point oldest) {
    const double lost_time = secondsBetween(oldest, Clock::now());
    recording_.store(false, std::memory_order_relaxed);
    checkpointer_.stop();
    finished_ = true;
    bool whole = false;
    try {
      whole = writer_.finish();
    } catch (const SqliteError&) {  // the disk is full; the log stays as it is
    }
    std::uint64_t lost = 0;
    {
      const std::lock_guard lock(mutex_);
      lost = lostNow();
      stats_.lost_time = lost > 0 ? lost_time : 0.0;
      takeSpace(space());
      stats_.time_left = 0.0;  // of a file that does not grow any more
    }
    std::error_code fault;
    if (!std::filesystem::exists(path_, fault)) return report(fmt::format("{}. {}", reason, advice));
    report(
        fmt::format("{}. {}. {}", reason, whole ? intactText(lost, lost_time) : besideText(path_), advice));
  }

  void report(std::string fault) {
    const std::lock_guard lock(mutex_);
    if (stats_.state == RecorderState::kFailed) return;
    stats_.state = RecorderState::kFailed;
    stats_.error = path_.string() + ": " + std::move(fault);
  }

  /// Number of rows taken that are not in the file. The caller holds mutex_.
  std::uint64_t lostNow() const {
    const std::uint64_t queued = queued_.load(std::memory_order_relaxed);
    return queued - std::min(queued, stats_.written);
  }
  DiskSpace space() const { return spaceOf(path_, options_); }
  void takeSpace(const DiskSpace& space) {
    stats_.free_bytes = space.free;
    stats_.free_known = space.size > 0;
  }

  const std::filesystem::path path_;
  const RecorderOptions options_;
  const double interval_;
  const std::uint64_t reserve_;
  std::unique_ptr<ImageBlock>
      images_;  ///< memory of frames_; before writer_, so that no file is left without it
  SessionWriter writer_;
  SpscRing<Record> records_;
  SpscRing<FrameSlot> frames_;
  Checkpointer checkpointer_;
  std::atomic<std::int64_t> seq_{1};
  std::atomic<std::uint64_t> queued_{0}, dropped_{0}, dropped_frames_{0};
  std::atomic<bool> recording_{true};
  mutable std::mutex mutex_;  ///< protects closing_, messages_, stats_
  std::condition_variable wake_;
  bool closing_ = false;
  std::vector<Message> messages_;
  RecorderStats stats_;
  bool cut_short_ = false;  ///< writer's thread: the last transaction left rows in the queue
  bool finished_ = false;   ///< a fault has closed the file (writer's thread until it is joined)
  GrowthRate growth_;
  std::thread thread_;
};

Recorder::Recorder(const std::filesystem::path& path, const SessionHeader& header,
                   const RecorderOptions& options)
    : impl_(std::make_unique<Impl>(path, header, options)) {}
Recorder::~Recorder() = default;

bool Recorder::offer(const tracking::Sample& sample) { return impl_->offer(sample); }
bool Recorder::offer(const tracking::Snapshot& snapshot) { return impl_->offer(snapshot); }
void Recorder::note(double t, std::string kind, std::string text) {
  impl_->note({t, std::move(kind), std::move(text)});
}
void Recorder::setRegistration(double t, const Eigen::Isometry3d& base_from_camera) {
  impl_->note({t, "registration", formatPose(base_from_camera)}, base_from_camera);
}
void Recorder::setMarker(double t, const std::string& marker) {
  impl_->note({t, "marker", "new colour limits"}, std::nullopt, marker);
}
void Recorder::close() { impl_->close(); }
RecorderStats Recorder::stats() const { return impl_->stats(); }
const std::filesystem::path& Recorder::path() const { return impl_->path(); }

}  // namespace capstan::recording
