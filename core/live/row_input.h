#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "core/live/streams/byte_stream.h"
#include "core/recording/measured_table.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// Messages that this program lost, since they had to wait for too long.
struct LostMessages {
  std::uint64_t rows = 0, encoders = 0;
};

/// Rows of a measured table that another program sends while it measures them.
class RowInput {
 public:
  virtual ~RowInput() = default;
  /// Address, for status and errors.
  virtual std::string name() const = 0;
  /// Waits up to `wait` for something to come. Throws base::InputError for a fault of the system.
  virtual ReadState read(std::chrono::milliseconds wait) = 0;
  /// Rows that have come, in SI; nothing: none. Throws base::InputError for rows that cannot be used.
  virtual std::optional<recording::MeasuredTable> take() = 0;
  /// Tells the sender `reason`, if it can be told, and goes on with a new one.
  virtual void refuse(const std::string& reason) = 0;
  /// The rows that take() has just returned are in use: their sender keeps its place.
  virtual void confirm() {}
  /// Throws base::InputError if the times of `rows`, which take() has just returned, do not rise.
  virtual void checkOrder(const recording::MeasuredTable& rows) = 0;
  /// Why nothing comes, empty where there is no such reason; nothing: as before. May take a second.
  virtual std::optional<std::string> hint() { return {}; }
  /// Lost so far, of an input whose sender does not wait.
  virtual LostMessages lost() const { return {}; }
  /// Rows excluded so far, since their connection ended within them.
  virtual std::uint64_t incomplete() const { return 0; }
  /// Joint encoders of messages of their own.
  virtual tracking::EncoderStatus encoders() const { return {}; }
  /// Stamp of the ROS clock at time 0 of the rows [ns]; nothing: their times are of another clock.
  virtual std::optional<std::int64_t> rosStampOfZero() const { return {}; }
};

}  // namespace capstan::live
