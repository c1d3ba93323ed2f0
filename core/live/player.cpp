#include "core/live/player.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <tuple>

#include "core/base/error.h"

namespace capstan::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr const char* kGarbage = "garbage\n";

/// Connection that is made again when the receiver has ended it.
class Connection {
 public:
  Connection(std::unique_ptr<TcpSender> sender, std::string header, PlayReport& report)
      : to_(sender->address()), header_(std::move(header)), report_(report), sender_(std::move(sender)) {
    sender_->send(header_);
  }
  /// False: nobody listens now.
  bool send(const std::string& bytes) {
    if (sender_ && sender_->send(bytes)) return true;
    noteAnswer();
    return connect() && sender_->send(header_) && sender_->send(bytes);
  }
  void noteAnswer() {
    if (!sender_) return;
    if (std::string answer = sender_->answer(); !answer.empty()) report_.answer = std::move(answer);
  }

 private:
  bool connect() {
    constexpr std::chrono::milliseconds kPause{500};  // between two attempts
    if (Clock::now() < next_) return false;
    try {
      sender_ = std::make_unique<TcpSender>(to_);
    } catch (const base::InputError&) {
      sender_.reset();
      report_.refused = true;
      next_ = Clock::now() + kPause;
      return false;
    }
    report_.refused = false;
    ++report_.connections;
    return true;
  }

  const Address to_;
  const std::string header_;
  PlayReport& report_;
  std::unique_ptr<TcpSender> sender_;
  Clock::time_point next_;  ///< attempt
};

}  // namespace

void PlayClock::waitUntil(double since_begin) const {
  if (speed > 0.0)
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(
                                              std::chrono::duration<double>(since_begin / speed)));
}

double PlayClock::overdueBy(double since_begin) const {
  if (speed <= 0.0) return 0.0;
  return std::max(std::chrono::duration<double>(Clock::now() - start).count() - since_begin / speed, 0.0);
}

std::int64_t PlayClock::stampOf(double t) const {
  return static_cast<std::int64_t>(std::llround(1e9 * (started + (speed > 0.0 ? (t - begin) / speed : 0.0))));
}

PlayReport playRows(const recording::MeasuredTable& table, std::unique_ptr<TcpSender> receiver,
                    const PlayClock& clock, const PlayOptions& options, base::Progress* progress) {
  PlayReport report;
  Connection connection(std::move(receiver), recording::measuredTableHeader(table), report);
  FaultyRows rows(options.faults, options.seed);
  recording::MeasuredTable stamped = table;
  const Clock::time_point start = Clock::now();
  const double duration = std::max(table.t.back() - clock.begin, 1e-9);
  for (std::size_t k = 0; k < table.rows() && !(progress && progress->cancelled()); ++k) {
    const auto played = rows.next(k, table.t[k], clock.begin);
    if (!played) {
      ++report.withheld;
      continue;
    }
    clock.waitUntil(played->due);
    stamped.t[played->row] = played->stamp;
    const std::string line = recording::formatMeasuredRow(stamped, played->row);
    if (!connection.send((played->garbage ? kGarbage : "") + line + (played->twice ? line : ""))) {
      if (!options.keep_on) break;
      ++report.lost;
      continue;
    }
    ++report.sent;
    if (progress && k % 256 == 0) progress->report((table.t[k] - clock.begin) / duration, "playing");
  }
  report.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  connection.noteAnswer();
  return report;
}

bool ImagePacer::wait(double due) {
  const bool late = clock_.overdueBy(due) > kOverdue;
  if (late && Clock::now() - sent_ < std::chrono::duration<double>(kOverdue)) return ++report_.skipped, false;
  clock_.waitUntil(due);
  sent_ = Clock::now();
  ++report_.sent;
  if (late) ++report_.late;
  return true;
}

ImagePlayReport playImages(tracking::Source& source, ImageServer& server, const PlayClock& clock,
                           const PlayOptions& options, const base::Progress* progress) {
  ImagePlayReport report;
  ImagePacer pacer(clock, report);
  FaultyRows pairs(options.faults, options.seed);
  tracking::Sample sample;
  tracking::StereoFrame shown;
  for (std::size_t k = 0; source.next(sample) && !(progress && progress->cancelled());) {
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (!frame) continue;
    const auto played = pairs.next(k, frame->t_arrival, clock.begin);
    if (played && played->row == k)
      shown = {frame->t, frame->t_arrival, frame->left.clone(), frame->right.clone()};
    ++k;
    if (!played) {
      ++report.withheld;
      continue;
    }
    if (!pacer.wait(played->due)) continue;
    const auto& [first, second] =
        played->swapped ? std::tie(shown.right, shown.left) : std::tie(shown.left, shown.right);
    server.publish(first, second, clock.stampOf(frame->t));
  }
  return report;
}

}  // namespace capstan::live
