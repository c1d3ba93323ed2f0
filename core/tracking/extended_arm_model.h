#pragma once

#include <Eigen/Core>

#include "core/estimation/models.h"
#include "core/robot/chain/chain_lanes.h"
#include "core/robot/chain/chain_model.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::tracking {

/// Memory of the cables: their internal states besides the joints' motion.
struct CableMemory {
  Eigen::Vector3d hysteresis = Eigen::Vector3d::Zero();  ///< Bouc–Wen state z [m]
  Eigen::Vector3d creep = Eigen::Vector3d::Zero();       ///< creep elongation [m]
};

/// Link-side model of a robot with effects. Sigma points advance in parallel in the lanes of robot/chain's
/// kernel; every lane has the same constants. Motor positions are linear over a step, and the motor velocity
/// is their slope. The measured velocities that CableArmModel uses are not used here, because most of them
/// are delayed.
class ExtendedArmModel {
 public:
  using Points = estimation::SigmaPoints<6>;

  /// `low`, `high`: bounds of plausible states, as in CableArmConstants.
  ExtendedArmModel(const robot::Description& robot, const double (&low)[6], const double (&high)[6],
                   math::InstructionSet set);

  /// True if `robot` has effects that constants of the nominal model cannot express (robot::foldEffects()).
  static bool isNeededFor(const robot::Description& robot);

  void propagate(Points& points, const CableArmDrive& drive, const CableMemory& memory, double dt) const;
  /// Cable memory after a step of the state `x`.
  CableMemory remember(const Eigen::Matrix<double, 6, 1>& x, const CableArmDrive& drive,
                       const CableMemory& memory, double dt) const;
  /// Force gamma [N] of the cable of joint 0, 1 or 2 at a stretch [m] and stretch rate [m/s], with the joint
  /// at q [rad or m].
  double tension(int joint, double stretch, double rate, double q, const CableMemory& memory) const;
  /// True if the cables have memory (hysteresis or creep).
  bool hasMemory() const { return has_memory_; }

  /// Bound on the magnitude of the model's eigenvalues [1/s]: the largest robot::chainRate() on a grid of
  /// joint positions within the limits.
  double rate() const { return rate_; }
  const robot::ChainModel& model() const { return model_; }

 private:
  void run(robot::ChainState<robot::ChainLane>& state, const CableArmDrive& drive, double dt) const;

  robot::ChainModel model_;
  robot::ChainNumbers<robot::ChainLane> lanes_;
  robot::SimulateChain kernel_;
  double low_[6], high_[6];
  double rate_ = 0.0;
  double oscillation_ = 0.0;  ///< largest robot::chainOscillation() on the same grid [1/s]
  bool has_memory_ = false;
};

}  // namespace capstan::tracking
