#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/identification/drive_identification.h"

namespace capstan::identification {

/// Unknowns and residuals of the least-squares problem of identifyDrive().
class DriveFit {
 public:
  DriveFit(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
           const DriveOptions& options);

  using Held = std::array<bool, kDriveQuantities>;  ///< true: the parameter is fixed

  /// Solves from the present unknowns, then measures the noise; repeats until the noise is steady.
  BatchEnd solve(const Held& held, base::Progress* progress);
  /// Covariance of the free parameters, in their order, then of the offsets.
  Eigen::MatrixXd covariance(const Held& held) const;

  /// Whitened residuals of one recording with Huber's loss applied, r̃² = 2 ρ(r), and their derivatives by the
  /// logarithms and by the offset.
  struct Residuals {
    std::vector<double> t;
    Eigen::VectorXd value;
    Eigen::Matrix<double, Eigen::Dynamic, kDriveQuantities, Eigen::RowMajor> by_log;
    Eigen::VectorXd by_offset;
  };
  void evaluate(std::size_t file, const double* logs, double offset, bool derivatives, Residuals& out) const;
  Eigen::Index residualCount(std::size_t file) const { return counts_[file]; }

  DriveLogs logs = DriveLogs::Zero();
  std::vector<double> offsets;  ///< encoder zeros: one for all recordings, or one per recording [rad or m]
  std::size_t offsetOf(std::size_t file) const { return offsets.size() == 1 ? 0 : file; }

  double angleNoise() const { return angle_noise_; }    ///< [rad or m]
  double torqueNoise() const { return torque_noise_; }  ///< [N·m]
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
