#pragma once

#include <Eigen/Core>

#include "core/estimation/models.h"
#include "core/robot/chain/chain_lanes.h"
#include "core/robot/chain/chain_model.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::tracking {

/// What cables remember beside the joints' motion.
struct CableMemory {
  Eigen::Vector3d hysteresis = Eigen::Vector3d::Zero();  ///< Bouc–Wen z [m]
  Eigen::Vector3d creep = Eigen::Vector3d::Zero();       ///< elongation [m]
};

/// The link side of a robot with effects, sigma points side by side in the lanes of robot/chain's kernel;
/// every lane has the same numbers. Motor positions are linear over a step, and their velocity
/// is the slope: measured velocities, which CableArmModel takes, mostly come late.
class ExtendedArmModel {
 public:
  using Points = estimation::SigmaPoints<6>;

  /// `low`, `high`: the box of believable states, as CableArmConstants has it.
  ExtendedArmModel(const robot::Description& robot, const double (&low)[6], const double (&high)[6],
                   math::InstructionSet set);

  /// True: `robot` has effects that the nominal model's numbers cannot hold (robot::foldEffects()).
  static bool isNeededFor(const robot::Description& robot);

  void propagate(Points& points, const CableArmDrive& drive, const CableMemory& memory, double dt) const;
  /// The memory behind a step of the state `x`.
  CableMemory remember(const Eigen::Matrix<double, 6, 1>& x, const CableArmDrive& drive,
                       const CableMemory& memory, double dt) const;
  /// Force gamma of joint 0, 1 or 2's cable [N] at a stretch [m] and its rate, the joint at q [rad or m].
  double tension(int joint, double stretch, double rate, double q, const CableMemory& memory) const;
  /// Cables have any.
  bool hasMemory() const { return has_memory_; }

  /// Bound on the eigenvalues anywhere in the joint limits [1/s]: the largest robot::chainRate() of a grid.
  double rate() const { return rate_; }
  const robot::ChainModel& model() const { return model_; }

 private:
  void run(robot::ChainState<robot::ChainLane>& state, const CableArmDrive& drive, double dt) const;

  robot::ChainModel model_;
  robot::ChainNumbers<robot::ChainLane> lanes_;
  robot::SimulateChain kernel_;
  double low_[6], high_[6];
  double rate_ = 0.0;
  double oscillation_ = 0.0;  ///< the part of it that steps must follow [1/s]
  bool has_memory_ = false;
};

}  // namespace capstan::tracking
