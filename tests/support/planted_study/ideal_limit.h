#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <memory>

#include "tests/support/planted/planted_case.h"

namespace capstan::study {

/// How far an effect moves what the sensors tell, in standard deviations of everything else that may move it
/// the same way: what an observer could make of the recording who has the true model itself, knows the truth
/// but for the drift (and the texture, where there is one) and knows how those are drawn:
///     D² = dᵀ (Σ + J P Jᵀ)⁻¹ d
/// d: change of all sensors' readings by the effect, open loop over the motion of the robot without it; Σ:
/// the sensors' white noise; J: change by each drifted number of each joint (stiffness, damping, friction of
/// joint and motor, mass, centre of mass) and by the background texture; P: their variances as they are
/// drawn. Linear in the drift. From the case's first `seconds`, taken to come as often as its length has
/// room for.
class IdealObserver {
 public:
  IdealObserver(const test::PlantedCase& planted_case, const test::Truth& truth, double seconds = 8.0);
  ~IdealObserver();
  IdealObserver(const IdealObserver&) = delete;
  IdealObserver& operator=(const IdealObserver&) = delete;

  /// D of an effect.
  double deflection(const test::Planted& planted);

  struct Limit {
    double share = 0.0;  ///< of the effect's magnitude
    double size = 0.0;
  };
  /// Where an effect of size `size` would be found by half: its magnitude is made so much smaller
  /// that D is kHalfFound (within 5 %), its size in the same measure as its change |Σ^-1/2 d|. D ∝ size where
  /// D is less than kHalfFound as it is, and of sensor_sign. NaN: it changes nothing.
  /// Where however little of it is found (the plant's play presses and does not pull, as soon as there is
  /// one), that is the limit.
  Limit limit(const test::Planted& planted, double size);

 private:
  class Sensors;
  Eigen::VectorXd change(const test::Planted& planted);
  double deflection(const Eigen::VectorXd& change) const;

  std::unique_ptr<Sensors> sensors_;
  robot::Description worn_;
  double times_ = 1.0;  ///< that the seconds looked at fit into the recording
  Eigen::VectorXd plain_;
  Eigen::MatrixXd spread_;  ///< Σ^-1/2 J P^1/2
  Eigen::LDLT<Eigen::MatrixXd> normal_;
};

/// D at which such an observer, who raises a false alarm in 3 % of sound robots and has 60 effects and joints
/// to choose from, finds half of all: normal quantile at 1 − 0.03/120.
inline constexpr double kHalfFound = 3.48;

}  // namespace capstan::study
