#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/identification_data.h"
#include "core/identification/parameters.h"

namespace capstan::identification {

/// Predicted link side at one exposure.
struct ArmPrediction {
  using ByParameter = Eigen::Matrix<double, 3, kMostParameters>;  ///< columns from the set's size on are zero
  Eigen::Vector3d q = Eigen::Vector3d::Zero();                    ///< joints [rad, rad, m]
  Eigen::Vector3d dq = Eigen::Vector3d::Zero();                   ///< joint velocities [rad/s, rad/s, m/s]
  ByParameter q_by_log = ByParameter::Zero();                     ///< d q / d ln w
  ByParameter dq_by_log = ByParameter::Zero();                    ///< d dq / d ln w
  /// Response of each link to an unknown hysteresis of its cable, relative to the largest one: −1…1
  /// (shooting.cpp). Computed together with the derivatives only.
  Eigen::Vector3d hysteresis = Eigen::Vector3d::Zero();
};

struct ShootingOptions {
  double segment = 100.0;  ///< length of the pieces into which the recording is cut [s]
  /// Run-in before each piece, after which its initial state has no effect [s]. 0: 15…30 s by the slowest
  /// time, at most a third of the segment without gaps that contains the piece.
  double warm_up = 0.0;
  int threads = 2;  ///< number of pieces in parallel; the result does not depend on it
};

/// Output of the filter's link dynamics (cable_arm_model.h: UKF paper (5)–(10), RK4, motor angles linear
/// between samples) as a function of the parameters, with derivatives by forward-mode automatic
/// differentiation (link_kernel.h).
///
/// The initial state fades: a link settles on its motor within `slowestTime()`. So the initial state of a
/// piece is not an unknown: the piece starts `warm_up` early with unstretched cables, and then its output is
/// that of a run over the whole recording. Pieces run in parallel. Motor speed is the difference quotient of
/// the angles. A measured, filtered speed has a lag, which would appear as a force in the cable damper.
/// Observations within `warm_up` after the recording's start or after a gap in the motor samples are
/// excluded.
class Shooting {
 public:
  /// `data` and `set` must outlive it.
  Shooting(const IdentificationData& data, const ParameterSet& set, const ShootingOptions& options = {});

  /// Indices into data.cameras of the observations in use: open, and after the warm-up.
  const std::vector<std::size_t>& used() const { return used_; }
  /// True when there is no gap in the motor samples between used()[k − 1] and used()[k].
  bool continues(std::size_t k) const { return k > 0 && segment_[k] == segment_[k - 1]; }

  /// Computes one prediction per used() observation. Returns false when cancelled.
  bool predict(const ParameterSet::Logs& logs, bool derivatives, std::vector<ArmPrediction>& out,
               const base::Progress* progress = nullptr) const;

 private:
  struct Piece {
    std::size_t first = 0, last = 0;  ///< range in used_
    std::size_t start = 0;            ///< motor sample at which the run starts
  };
  void run(const Piece& piece, const ParameterSet::Logs& logs, double rate, bool derivatives,
           std::vector<ArmPrediction>& out) const;

  const IdentificationData& data_;
  const ParameterSet& set_;
  ShootingOptions options_;
  std::vector<std::size_t> used_;
  std::vector<std::size_t> segment_;  ///< first motor sample of the segment of each used() observation
  std::vector<Piece> pieces_;
};

}  // namespace capstan::identification
