#pragma once

#include <algorithm>

namespace capstan::live {

/// Finds, by their arrivals [s], the images of a network stream that have waited on their way: those of the
/// first second after the stream was opened (a relay examines the beginning of a stream before it sends it
/// on), and those that follow a silence, for as long as it has lasted. Without stamps, nothing shows when
/// such an image was exposed.
class Backlog {
 public:
  static constexpr double kBegin = 1.0;     ///< images of this time after opening have waited [s]
  static constexpr double kSilence = 0.35;  ///< a longer gap is a silence [s]

  /// The stream is opened.
  void restart() { opened_ = false; }
  /// Adds the arrival of an image. Returns true if it may have waited.
  bool add(double arrival) {
    if (!opened_)
      until_ = arrival + kBegin;
    else if (const double gap = arrival - newest_; gap > kSilence)
      until_ = std::max(until_, arrival + std::min(gap, kBegin));
    opened_ = true;
    newest_ = arrival;
    return waits();
  }
  /// Whether the newest image may have waited.
  bool waits() const { return opened_ && newest_ < until_; }

 private:
  bool opened_ = false;
  double newest_ = 0.0, until_ = 0.0;
};

}  // namespace capstan::live
