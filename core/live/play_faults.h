#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

namespace capstan::live {

/// Fault that `play` adds to the rows or images that it sends.
struct PlayFault {
  enum class Kind {
    kDrop,     ///< a share of the rows or pairs of images is not sent
    kRepeat,   ///< a share of the rows is sent twice
    kJitter,   ///< they are sent late by exponential delays of this mean [s], in order
    kSilence,  ///< nothing is sent for a time
    kFreeze,   ///< the values of one row, or one pair of images, are sent for a time
    kStep,     ///< the stamps of the rows jump by an amount
    kGarbage,  ///< one line is no row
    kSwap,     ///< left and right images are exchanged for a time
  };
  Kind kind = Kind::kDrop;
  double amount =
      0.0;            ///< kDrop, kRepeat: share; kJitter, kStep: [s]; kSilence, kFreeze, kSwap: duration [s]
  double time = 0.0;  ///< of kSilence, kFreeze, kStep, kGarbage and kSwap, from the first row [s]
};

/// Parses a fault of rows: "drop:0.01", "repeat:0.01", "jitter:0.02", "silence:2@10", "freeze:2@10",
/// "step:0.5@10" or "garbage@10" (2 s long, at 10 s). Throws base::InputError that names `option` and the
/// text.
PlayFault parseRowFault(const std::string& text, const std::string& option);
/// Parses a fault of images: drop, jitter, silence or freeze as above, or "swap:2@10".
PlayFault parseImageFault(const std::string& text, const std::string& option);

/// One row, or one pair of images, to send.
struct PlayedRow {
  double due = 0.0;     ///< when to send it, from the first row on [s]
  double stamp = 0.0;   ///< t of the row [s]
  std::size_t row = 0;  ///< row whose values are sent
  bool twice = false, garbage = false, swapped = false;
};

/// What is sent of a recording with faults, row by row or pair by pair; deterministic for one seed.
class FaultyRows {
 public:
  FaultyRows(std::vector<PlayFault> faults, unsigned seed) : faults_(std::move(faults)), random_(seed) {}
  /// Row `row` with time `t` [s], whose recording begins at `begin`; nothing if it is not sent. Rows come in
  /// order.
  std::optional<PlayedRow> next(std::size_t row, double t, double begin);

 private:
  std::vector<PlayFault> faults_;
  std::mt19937 random_;
  std::optional<std::size_t> frozen_;
  double last_due_ = 0.0;
  std::vector<bool> garbage_sent_ = std::vector<bool>(faults_.size());
};

}  // namespace capstan::live
