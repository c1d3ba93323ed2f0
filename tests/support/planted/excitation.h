#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/robot/description.h"
#include "tests/support/planted/rigid_chain.h"

namespace capstan::test {

/// Smooth step from 0 to 1 for x from 0 to 1, with zero velocity and acceleration at both ends.
double smoothStep(double x);

/// Kinds of commanded motion.
enum class MotionStyle {
  kMoves,      ///< joints move independently: all speeds, whole range, dwells, short moves back, fading sines
  kTransfer,   ///< all joints move together between three to five poses, with dwells, again and again
  kSweeps,     ///< one joint after the other moves, the others stand still
  kMultisine,  ///< a sum of five sines in each joint
};

/// Random commanded motion of the joints. It is twice continuously differentiable, inside the joint limits,
/// and below 0.85 of the joints' highest speed.
class Excitation {
 public:
  Excitation(const robot::Description& robot, double duration, base::Random& random,
             MotionStyle style = MotionStyle::kMoves);

  /// Desired joint positions at t [rad or m]; before t = 0 those at 0.
  Joints at(double t) const;

 private:
  struct Move {
    double begin, end, from, to;
  };
  struct Sine {
    double amplitude, frequency, phase;
  };
  struct Swell {
    double begin, end;
    std::vector<Sine> sines;
  };
  struct Axis {
    std::vector<Move> moves;  ///< in order of time
    std::vector<Swell> swells;
    double start = 0.0;
    double low = 0.0, high = 0.0;  ///< range of the moves
    double speed = 0.0;            ///< highest speed of a move
  };

  void addMoves(Axis& axis, double duration, base::Random& random);
  void addSwells(Axis& axis, double amplitude, double speed, double duration, base::Random& random);

  void addTransfer(double duration, base::Random& random);
  void addSweeps(double duration, base::Random& random);
  void addMultisine(Axis& axis, double duration, base::Random& random);

  std::vector<Axis> axes_;
};

/// Loads on the joints as of a hand or a weight: of both signs, and slow compared with the motion.
class ExternalLoad {
 public:
  /// `amplitude` is the amplitude per joint [N·m or N]; 0: no load.
  ExternalLoad(const Joints& amplitude, base::Random& random);
  Joints at(double t) const;

 private:
  Joints amplitude_{};
  std::array<Joints, 2> frequency_{}, phase_{};
};

}  // namespace capstan::test
