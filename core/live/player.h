#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/live/play_faults.h"
#include "core/live/streams/address.h"
#include "core/recording/measured_table.h"

namespace capstan::live {

struct PlayOptions {
  double speed = 1.0;  ///< recording time per wall time; 0: as fast as the receiver takes
  std::vector<PlayFault> faults;
  unsigned seed = 1;
};

struct PlayReport {
  std::uint64_t sent = 0, withheld = 0;  ///< rows
  std::uint64_t connections = 1;
  double seconds = 0.0;  ///< of sending
  std::string answer;    ///< last answer of the receiver; empty: none
  bool refused = false;  ///< the receiver has disconnected, and could not be reached again
};

/// Sends the rows of a recording to the program that listens at `to`, in real time, as a robot would. After a
/// disconnection it connects again and sends the header line again. Throws base::InputError where nothing
/// listens.
PlayReport playRows(const recording::MeasuredTable& table, const Address& to, const PlayOptions& options,
                    base::Progress* progress);

}  // namespace capstan::live
