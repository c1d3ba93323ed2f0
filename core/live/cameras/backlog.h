#pragma once

#include <algorithm>

namespace capstan::live {

/// Finds, by their arrivals [s], the images of a network stream that may have waited on their way: those of
/// the first second after the stream was opened (a relay examines the beginning of a stream before it sends
/// it on), and those that follow a silence, for as long as it has lasted, and a second at most. Without
/// stamps, nothing shows when such an image was exposed. A gap is a silence where it is long, and much longer
/// than those of the stream usually are.
class Backlog {
 public:
  static constexpr double kMost = 1.0;      ///< images have waited for so long at most [s]
  static constexpr double kSilence = 0.35;  ///< a shorter gap is no silence [s]
  static constexpr double kUsual = 3.0;     ///< and neither is a gap of fewer usual ones

  /// The stream is opened.
  void restart() { *this = {}; }
  /// Adds the arrival of an image. Returns true if it may have waited.
  bool add(double arrival) {
    if (!opened_) {
      until_ = arrival + kMost;
    } else {
      const double gap = arrival - newest_;
      if (gap > kSilence && usual_ > 0.0 && gap > kUsual * usual_)
        until_ = std::max(until_, arrival + std::min(gap, kMost));
      constexpr double kGain = 0.2;
      usual_ += (usual_ > 0.0 ? kGain : 1.0) * (std::min(gap, kMost) - usual_);
    }
    opened_ = true;
    newest_ = arrival;
    return waits();
  }
  /// Whether the newest image may have waited.
  bool waits() const { return opened_ && newest_ < until_; }

 private:
  bool opened_ = false;
  double newest_ = 0.0, until_ = 0.0;
  double usual_ = 0.0;  ///< running mean of the gaps [s]; 0: none yet
};

}  // namespace capstan::live
