#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/identification/drive_identification.h"

namespace capstan::identification {

/// The least-squares problem of identifyDrive(): unknowns and residuals.
class DriveFit {
 public:
  DriveFit(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
           const DriveOptions& options);

  using Held = std::array<bool, kDriveQuantities>;  ///< parameters that stay where they are

  /// Solves from the present unknowns; then the noise is measured again, until it rests.
  BatchEnd solve(const Held& held, base::Progress* progress);
  /// Of the parameters not held, in their order, then of the offsets.
  Eigen::MatrixXd covariance(const Held& held) const;

  /// Whitened residuals of one recording, held back as Huber's loss does, r̃² = 2 ρ(r); with derivatives by
  /// the logarithms and by the offset.
  struct Residuals {
    std::vector<double> t;
    Eigen::VectorXd value;
    Eigen::Matrix<double, Eigen::Dynamic, kDriveQuantities, Eigen::RowMajor> by_log;
    Eigen::VectorXd by_offset;
  };
  void evaluate(std::size_t file, const double* logs, double offset, bool derivatives, Residuals& out) const;
  Eigen::Index residualCount(std::size_t file) const { return counts_[file]; }

  DriveLogs logs = DriveLogs::Zero();
  std::vector<double> offsets;  ///< one, or one a recording [rad or m]
  std::size_t offsetOf(std::size_t file) const { return offsets.size() == 1 ? 0 : file; }

  double angleNoise() const { return angle_noise_; }
  double torqueNoise() const { return torque_noise_; }
  double torqueSign() const { return torque_sign_; }
  double outliers() const;  ///< share of residuals beyond Huber's limit
  int observations() const;
  int iterations() const { return iterations_; }

 private:
  bool counts(const DriveRecording& recording, std::size_t row) const;
  void start();
  bool measureNoise();

  const std::vector<DriveRecording>& recordings_;
  const DriveParameters& parameters_;
  DriveOptions options_;
  std::vector<Eigen::Index> counts_;
  double torque_sign_ = 1.0, angle_noise_ = 0.005, torque_noise_ = 0.01;
  int iterations_ = 0;
};

}  // namespace capstan::identification
