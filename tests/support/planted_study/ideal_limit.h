#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <memory>

#include "tests/support/planted/planted_case.h"

namespace capstan::study {

/// Observer with the best possible detection of an effect. It has the true model, and knows everything except
/// the drift and the texture, of which it knows the distributions. Its detection index D is the change of the
/// readings by the effect, in standard deviations of all other changes of the same form:
///     D² = dᵀ (Σ + J P Jᵀ)⁻¹ d
/// d: change of all readings by the effect, simulated open loop over the motion of the robot without it; Σ:
/// covariance of the sensors' white noise; J: changes by each drifted number of each joint (stiffness,
/// damping, friction of joint and motor, mass, centre of mass) and by the background texture; P: the
/// variances that these are drawn with. The model is linear in the drift. D is computed from the first
/// `seconds` of the case and scaled as if they were repeated over its duration.
class IdealObserver {
 public:
  IdealObserver(const test::PlantedCase& planted_case, const test::Truth& truth, double seconds = 8.0);
  ~IdealObserver();
  IdealObserver(const IdealObserver&) = delete;
  IdealObserver& operator=(const IdealObserver&) = delete;

  /// Detection index D of an effect.
  double deflection(const test::Planted& planted);

  struct Limit {
    double share = 0.0;  ///< limit as a share of the effect's magnitude
    double size = 0.0;
  };
  /// Detection limit of an effect that has the size `size` as planted. Its magnitude is reduced until D is
  /// kHalfFound (within 5 %); its size is reduced in proportion to its change |Σ^-1/2 d|. For sensor_sign,
  /// and if D is below kHalfFound as planted, D is taken as proportional to size. NaN: the effect changes no
  /// reading. If even the smallest magnitude is detected (any play changes the plant, since it presses and
  /// does not pull), that magnitude is the limit.
  Limit limit(const test::Planted& planted, double size);

 private:
  class Sensors;
  Eigen::VectorXd change(const test::Planted& planted);
  double deflection(const Eigen::VectorXd& change) const;

  std::unique_ptr<Sensors> sensors_;
  robot::Description worn_;
  double times_ = 1.0;  ///< duration of the recording over the `seconds` that are used
  Eigen::VectorXd plain_;
  Eigen::MatrixXd spread_;  ///< Σ^-1/2 J P^1/2
  Eigen::LDLT<Eigen::MatrixXd> normal_;
};

/// D at which this observer detects half of the effects, with false alarms in 3 % of robots without a fault
/// and 60 combinations of effect and joint: normal quantile at 1 − 0.03/120.
inline constexpr double kHalfFound = 3.48;

}  // namespace capstan::study
