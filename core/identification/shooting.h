#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/identification_data.h"
#include "core/identification/parameters.h"

namespace capstan::identification {

/// Where the motors and a set of parameters put the link side at one exposure.
struct ArmPrediction {
  using ByParameter = Eigen::Matrix<double, 3, kMostParameters>;  ///< columns behind the set's size are zero
  Eigen::Vector3d q = Eigen::Vector3d::Zero();                    ///< [rad, rad, m]
  Eigen::Vector3d dq = Eigen::Vector3d::Zero();                   ///< per second
  ByParameter q_by_log = ByParameter::Zero();                     ///< d q / d ln w
  ByParameter dq_by_log = ByParameter::Zero();
  /// What the link has followed of a hysteresis of its cable, by the greatest it could: −1…1 (shooting.cpp);
  /// with derivatives only, as it is requested with them.
  Eigen::Vector3d hysteresis = Eigen::Vector3d::Zero();
};

struct ShootingOptions {
  double segment = 100.0;  ///< recording is cut into pieces of this length [s]
  double warm_up = 0.0;  ///< run before a piece, in which the arm forgets its start [s]; 0: 15…30 s by its
                         ///< slowest time, at most a third of the stretch without a gap that it stands in
  int threads = 2;       ///< pieces at the same time; the result does not depend on it
};

/// Output of the filter's own link dynamics (cable_arm_model.h: UKF paper (5)–(10), RK4, motor angles linear
/// between samples) as a function of the parameters, with its derivatives by forward-mode automatic
/// differentiation (link_kernel.h).
///
/// The arm forgets: a link settles on its motor within `slowestTime()`. So a piece of the recording needs no
/// initial state as unknown; it starts `warm_up` early at the unstretched cable, and what it outputs then is
/// the output of the whole recording. Pieces run in parallel. Motor speed is the difference quotient of the
/// angles, without the lag of a measured, filtered speed: a cable damper would take the lag for a force.
/// Observations within a warm-up of the recording's start or of a gap in the motor samples are excluded.
class Shooting {
 public:
  /// `data` and `set` must outlive it.
  Shooting(const IdentificationData& data, const ParameterSet& set, const ShootingOptions& options = {});

  /// Indices into data.cameras of the observations in use: gate open, warmed up.
  const std::vector<std::size_t>& used() const { return used_; }
  /// used()[k] stands in the same stretch of motor samples as used()[k − 1]: no gap between them.
  bool continues(std::size_t k) const { return k > 0 && segment_[k] == segment_[k - 1]; }

  /// One prediction per used() observation. False: cancelled.
  bool predict(const ParameterSet::Logs& logs, bool derivatives, std::vector<ArmPrediction>& out,
               const base::Progress* progress = nullptr) const;

 private:
  struct Piece {
    std::size_t first = 0, last = 0;  ///< of used_
    std::size_t start = 0;            ///< motor sample to run from
  };
  void run(const Piece& piece, const ParameterSet::Logs& logs, double rate, bool derivatives,
           std::vector<ArmPrediction>& out) const;

  const IdentificationData& data_;
  const ParameterSet& set_;
  ShootingOptions options_;
  std::vector<std::size_t> used_;
  std::vector<std::size_t> segment_;  ///< motor sample that the segment of a used() observation begins with
  std::vector<Piece> pieces_;
};

}  // namespace capstan::identification
