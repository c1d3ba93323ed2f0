#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"

namespace capstan::recording {

/// Format of rows of estimates.
enum class RowFormat {
  kCsv,       ///< a header line; unknown values are empty; 17 digits
  kJsonLines  ///< no header; a row has the keys of its known values
};

/// Turns snapshots into rows of text, one per motor sample and per camera sample: t, camera flag, t_cam,
/// q_kin, q_cam, q_ukf, dq_ukf, sigma, reference (at t; on rows of camera samples at t_cam), gate, NIS; SI.
/// The row of a motor sample waits for the reference of its time, which is the next sample where there is
/// one.
class EstimateRows {
 public:
  /// `row` is called with each complete row and its line end.
  EstimateRows(RowFormat format, std::function<void(const std::string&)> row);
  /// Line that precedes the rows, with its line end; empty for JSON Lines.
  std::string header() const;
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// Gives the row that waits for its reference, without it: no further sample has come, or will come.
  void flush();

 private:
  void give(const tracking::Snapshot& snapshot, const Eigen::Vector3d& reference) const;

  RowFormat format_;
  std::function<void(const std::string&)> row_;
  std::optional<tracking::Snapshot> motor_row_;
  Eigen::Vector3d reference_;
};

}  // namespace capstan::recording
