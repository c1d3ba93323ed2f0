#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/live/streams/clock_map.h"

namespace capstan::live {

/// Times of the images of one or two streams, by which they are paired, from the stamps of their clocks and
/// from their arrivals at this computer.
///
/// Streams of one clock are paired by their stamps; their ClockMap is common. Where the streams come from two
/// computers, and the times of their stamps on this computer's clock by a ClockMap each have been apart by
/// more than kApart for kDecide, the clocks are two. Images are then paired by their times on this computer's
/// clock. A stream without stamps has its arrivals. A single image without a stamp, or with one that its
/// clock does not confirm, has the stamp that would have come at its arrival.
class ImageClock {
 public:
  enum class Streams {
    kOneClock,   ///< of one computer, or of computers whose clocks are synchronised
    kMayDiffer,  ///< of two computers
  };
  explicit ImageClock(Streams streams) : may_differ_(streams == Streams::kMayDiffer) {}

  /// Adds an image of stream 0 or 1 with its stamp [ns] (0: none) and its arrival [s, this computer], in
  /// order of the arrivals of a stream. Returns the time by which it is paired [s].
  double add(int stream, std::int64_t stamp, double arrival);
  /// Time on this computer's clock [s] at which an image of this pairing time would have arrived with the
  /// smallest delay.
  double computerTime(double pairing_time) const;
  /// Stamp of a pairing time [ns]; nothing where the images have none of one clock.
  std::optional<std::int64_t> stampOf(double pairing_time) const;
  int steps() const { return common_.steps(); }  ///< of the clock that stampOf() is about
  bool separate() const { return separate_; }    ///< the clocks are two

  static constexpr double kApart = 0.1;   ///< [s]
  static constexpr double kDecide = 1.0;  ///< [s]

 private:
  struct Stream {
    ClockMap map;
    double newest = 0.0;  ///< stamp [s] after origin_
    bool stamped = false;
  };
  void decide(double arrival);
  bool byStamp() const { return origin_ != 0 && !separate_; }

  const bool may_differ_;
  std::array<Stream, 2> streams_;
  ClockMap common_;          ///< of the streams together
  std::int64_t origin_ = 0;  ///< first stamp [ns]; 0: none yet
  bool separate_ = false, decided_ = false;
  std::optional<double>
      opposite_since_;  ///< arrival since which the maps have shown the opposite of separate_ [s]
};

}  // namespace capstan::live
