#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "core/base/progress.h"
#include "core/live/cameras/image_server.h"
#include "core/live/play_faults.h"
#include "core/live/streams/tcp_sender.h"
#include "core/recording/measured_table.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// When samples of a recording are sent.
struct PlayClock {
  using Clock = std::chrono::steady_clock;
  double begin = 0.0;  ///< time of the recording at `start` [s]
  double speed = 1.0;  ///< recording time per wall time; 0: as fast as the receiver takes
  Clock::time_point start = Clock::now();
  /// The same as the time of this computer, since 1970 [s].
  double started = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();

  void waitUntil(double since_begin) const;
  /// How long ago this was due [s]; 0: not yet, or the speed is 0.
  double overdueBy(double since_begin) const;
  /// Time of this computer at which the time `t` of the recording [s] is played, since 1970 [ns].
  std::int64_t stampOf(double t) const;
};

struct PlayOptions {
  std::vector<PlayFault> faults;
  unsigned seed = 1;
  /// Goes on where nobody listens any more, as the images do: the rows until somebody listens again are lost.
  bool keep_on = false;
};

struct PlayReport {
  std::uint64_t sent = 0, withheld = 0;  ///< rows
  std::uint64_t lost = 0;                ///< rows that were due while nobody listened
  std::uint64_t connections = 1;
  double seconds = 0.0;  ///< of sending
  std::string answer;    ///< last answer of the receiver; empty: none
  bool refused = false;  ///< the receiver had disconnected, and could not be reached again, at the end
};

/// Sends the rows of a recording to a receiver in real time, as a robot would. After a disconnection it
/// connects again, and sends the header line again.
PlayReport playRows(const recording::MeasuredTable& table, std::unique_ptr<TcpSender> receiver,
                    const PlayClock& clock, const PlayOptions& options, base::Progress* progress);

struct ImagePlayReport {
  std::uint64_t sent = 0, withheld = 0;  ///< pairs of images
  std::uint64_t late = 0;                ///< of the sent ones, overdue by more than ImagePacer::kOverdue
  std::uint64_t skipped = 0;             ///< overdue by more than that, and not sent

  std::uint64_t pairs() const { return sent + withheld + skipped; }
};

/// Waits until a pair of images is due. On a computer that is too slow it skips what is overdue, except for
/// one in kOverdue.
class ImagePacer {
 public:
  ImagePacer(const PlayClock& clock, ImagePlayReport& report) : clock_(clock), report_(report) {}
  /// Waits for a pair that is due at a time since the begin [s], and counts it. False: it is to be skipped.
  bool wait(double due);

  static constexpr double kOverdue = 0.1;  ///< [s]

 private:
  const PlayClock& clock_;
  ImagePlayReport& report_;
  std::chrono::steady_clock::time_point sent_;
};

/// Serves the images of a session at the times at which they arrived there, with their times of exposure on
/// this computer's clock as stamps. `source` is opened before the clock starts, since that takes time.
/// Throws base::InputError for a session that cannot be read.
ImagePlayReport playImages(tracking::Source& source, ImageServer& server, const PlayClock& clock,
                           const PlayOptions& options, const base::Progress* progress);

}  // namespace capstan::live
