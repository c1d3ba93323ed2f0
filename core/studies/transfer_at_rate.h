#pragma once

#include <cstdint>
#include <filesystem>

#include "core/robot/description.h"

namespace capstan::studies {

/// Block transfer at `speed` times the rate of a 200 s one, as a recorded trajectory in a temporary file
/// (columns t, q1, q2, q3, every 5 ms). The destructor deletes the file.
class TransferAtRate {
 public:
  /// Throws base::InputError when the arm does not reach the board, or the file cannot be written.
  TransferAtRate(const robot::Description& robot, double speed, double duration, std::uint64_t seed);
  ~TransferAtRate();
  TransferAtRate(const TransferAtRate&) = delete;
  TransferAtRate& operator=(const TransferAtRate&) = delete;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace capstan::studies
