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

/// Numbers of one row; joints in rad, rad, m. What is unknown is not finite.
struct EstimateNumbers {
  double t = 0.0;       ///< [s]
  bool camera = false;  ///< row of a camera sample, else of a motor sample
  double t_cam = 0.0;   ///< time stamp of the camera sample [s]
  Eigen::Vector3d q_kin, q_cam, q_ukf, dq_ukf, sigma_ukf;
  Eigen::Vector3d q;  ///< reference at t; on rows of camera samples at t_cam
  tracking::Gate gate = tracking::Gate::kNoCamera;
  double nis = 0.0;
};

/// Turns snapshots into rows, one per motor sample and per camera sample. The row of a motor sample waits for
/// the reference of its time, which is the next sample where there is one.
class EstimateSequence {
 public:
  /// `row` is called with each complete row.
  explicit EstimateSequence(std::function<void(const EstimateNumbers&)> row);
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// Gives the row that waits for its reference, without it: no further sample has come, or will come.
  void flush();

 private:
  std::function<void(const EstimateNumbers&)> row_;
  std::optional<EstimateNumbers> motor_row_;
};

/// Turns snapshots into rows of text, as EstimateSequence: t, camera flag, t_cam, q_kin, q_cam, q_ukf,
/// dq_ukf, sigma, reference, gate, NIS; SI.
class EstimateRows {
 public:
  /// `row` is called with each complete row and its line end.
  EstimateRows(RowFormat format, std::function<void(const std::string&)> row);
  /// Line that precedes the rows, with its line end; empty for JSON Lines.
  std::string header() const;
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
    rows_.add(sample, snapshot);
  }
  /// As EstimateSequence::flush().
  void flush() { rows_.flush(); }

 private:
  RowFormat format_;
  EstimateSequence rows_;
};

}  // namespace capstan::recording
