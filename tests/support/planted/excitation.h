#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/robot/description.h"
#include "tests/support/planted/rigid_chain.h"

namespace capstan::test {

/// 0 to 1 over x from 0 to 1, velocity and acceleration zero at both ends.
double smoothStep(double x);

/// What the joints are asked to do: moves at all speeds to all places with dwells between them, many of them
/// short and back again, and sums of sines that come and go. Twice continuously differentiable, inside the
/// joint limits, below 0.85 of the joints' highest speed.
class Excitation {
 public:
  Excitation(const robot::Description& robot, double duration, base::Random& random);

  /// Wanted joint positions at t [rad or m]; before 0 those at 0.
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
    std::vector<Move> moves;  ///< by time
    std::vector<Swell> swells;
    double start = 0.0;
  };

  void addMoves(Axis& axis, double low, double high, double speed, double duration, base::Random& random);
  void addSwells(Axis& axis, double amplitude, double speed, double duration, base::Random& random);

  std::vector<Axis> axes_;
};

/// Loads that a hand or a weight puts on the joints, of both signs, slow beside the motion.
class ExternalLoad {
 public:
  /// amplitude: of each joint [N·m or N]; 0 where there is none.
  ExternalLoad(const Joints& amplitude, base::Random& random);
  Joints at(double t) const;

 private:
  Joints amplitude_{};
  std::array<Joints, 2> frequency_{}, phase_{};
};

}  // namespace capstan::test
