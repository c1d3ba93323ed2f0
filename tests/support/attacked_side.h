#pragma once

#include <atomic>
#include <map>
#include <string>
#include <thread>

#include "core/live/live_source.h"
#include "tests/support/mutated_stream.h"

namespace capstan::testing {

/// What came of mutated streams of one kind.
struct MutationCounts {
  std::uint64_t streams = 0;
  std::uint64_t refused = 0;   ///< by the motor side, which counts them and names the fault
  std::uint64_t answered = 0;  ///< of them, the sender got the reason
  std::uint64_t rows = 0;      ///< that were taken as rows of a robot
  std::uint64_t steps = 0;     ///< of the clock
};

/// A live motor side that listens on a TCP port of its own, and tracks what comes.
class AttackedSide {
 public:
  AttackedSide();
  ~AttackedSide();

  /// Sends a stream and counts what comes of it; then a robot sends valid rows. Every row of it has to be
  /// taken, and the estimates after it have to be finite; otherwise, and for an unnamed refusal, the stream
  /// is among failures().
  void send(const MutatedStream& stream);

  const std::map<std::string, MutationCounts>& counts() const { return counts_; }
  /// A sentence for each failure.
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  void track();
  void sendMutated(const MutatedStream& stream);
  void sendRobot(const MutatedStream& stream);
  tracking::SideStatus statusAtRest() const;
  void fail(const MutatedStream& stream, const std::string& what);
  tracking::SideStatus status() const { return source_.sides().front(); }

  live::LiveSource source_;
  const live::Address address_;
  std::map<std::string, MutationCounts> counts_;
  std::vector<std::string> failures_;
  std::atomic<std::uint64_t> tracked_ = 0;  ///< motor samples
  std::atomic<bool> quit_ = false, ended_ = false, backwards_ = false, finite_ = true;
  std::thread thread_;
};

}  // namespace capstan::testing
