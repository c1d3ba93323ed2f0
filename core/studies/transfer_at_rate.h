#pragma once

#include <cstdint>
#include <filesystem>

#include "core/robot/description.h"

namespace capstan::studies {

/// A block transfer at `speed` times the rate of one of 200 s, as a recorded trajectory in a file of its own
/// (columns t, q1, q2, q3, every 5 ms), which goes with this object.
class TransferAtRate {
 public:
  /// Throws base::InputError when the arm does not reach, or the file for the trajectory cannot be written.
  TransferAtRate(const robot::Description& robot, double speed, double duration, std::uint64_t seed);
  ~TransferAtRate();
  TransferAtRate(const TransferAtRate&) = delete;
  TransferAtRate& operator=(const TransferAtRate&) = delete;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace capstan::studies
