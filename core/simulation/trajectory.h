#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "core/base/field.h"
#include "core/base/names.h"
#include "core/base/units.h"
#include "core/robot/description.h"

namespace capstan::simulation {

/// Desired joints of one instant.
struct JointTarget {
  Eigen::Vector3d position;  ///< [rad, rad, m]
  Eigen::Vector3d velocity;  ///< [rad/s, rad/s, m/s]
};

/// A smooth path of the first three joints over time; a pure function of t, without allocation.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  /// Desired joints at t [s]; before 0 and after duration() the end points, at rest.
  virtual JointTarget at(double t) const = 0;
  virtual double duration() const = 0;  ///< [s]
  /// Where a check of limits and speeds looks next after t [s]: steps so dense that no extreme is missed by
  /// more than about a per cent, yet few enough for a day.
  virtual double nextInstant(double t) const { return t + kDenseStep; }

 protected:
  static constexpr double kDenseStep = 5e-3;  ///< [s]
};

enum class TrajectoryKind { kHold, kSinusoid, kBlockTransfer, kRecorded, kHardStop };

/// One position, held.
struct HoldSpec {
  Eigen::Vector3d position{base::toRadians(35.0), base::toRadians(90.0), 0.33};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.position, {"position", "rad, rad, m", "joints to hold", {-10.0, 10.0}, false});
  }
};

/// q_i(t) = centre_i + amplitude_i sin(2 pi frequency_i t) · ramp(t): amplitude grows and fades over two
/// seconds.
struct SinusoidSpec {
  Eigen::Vector3d centre{base::toRadians(40.0), base::toRadians(90.0), 0.32};
  Eigen::Vector3d amplitude{base::toRadians(25.0), base::toRadians(25.0), 0.05};
  Eigen::Vector3d frequency{0.11, 0.17, 0.23};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.centre, {"centre", "rad, rad, m", "middle of the oscillation", {-10.0, 10.0}, false});
    field(self.amplitude, {"amplitude", "rad, rad, m", "of each joint", {0.0, 10.0}, false});
    field(self.frequency, {"frequency", "Hz", "of each joint", {0.0, 5.0}, false});
  }
};

/// FLS block transfer (block_transfer.h). Path, tempo, pauses and tremor differ from seed to seed.
struct BlockTransferSpec {
  /// Joints that put the tip on the middle of the peg board.
  Eigen::Vector3d board{base::toRadians(33.0), base::toRadians(92.0), 0.315};
  double tremor = 1.5e-4;     ///< amplitude of physiological tremor [m]
  double pause_share = 0.25;  ///< share of the time spent grasping, handing over and thinking

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.board,
          {"board", "rad, rad, m", "joints with the tip on the peg board's middle", {-10.0, 10.0}, false});
    field(self.tremor, {"tremor", "m", "amplitude of the hand's tremor", {0.0, 2e-3}, false});
    field(self.pause_share, {"pause_share", "", "share of the time at rest", {0.05, 0.8}, false});
  }
};

/// A joint trajectory from a CSV table with the columns t, q1, q2, q3 (SI); others are ignored.
struct RecordedSpec {
  std::string file;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.file, {"file", "", "CSV with the columns t, q1, q2, q3", {}, false});
  }
};

/// From `start` to the hard stop q_hs, a rest there, and back, on quintics.
struct HardStopSpec {
  Eigen::Vector3d start{base::toRadians(35.0), base::toRadians(90.0), 0.33};
  double rest = 3.0;  ///< at the hard stop [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.start, {"start", "rad, rad, m", "joints to come from and go back to", {-10.0, 10.0}, false});
    field(self.rest, {"rest", "s", "time spent at the hard stop", {0.0, 600.0}, false});
  }
};

/// Which trajectory, how long, and the numbers of each kind.
struct TrajectorySpec {
  TrajectoryKind kind = TrajectoryKind::kBlockTransfer;
  double duration = 200.0;  ///< [s]; block transfer: 80…290; recorded and hard stop: their own
  HoldSpec hold;
  SinusoidSpec sinusoid;
  BlockTransferSpec block_transfer;
  RecordedSpec recorded;
  HardStopSpec hard_stop;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.kind, {"kind", "", "hold, sinusoid, block_transfer, recorded or hard_stop", {}, false});
    field(self.duration, {"duration", "s", "length of the movement", {0.1, 86400.0}, false});
    field(self.hold, {"hold", "", "kind hold", {}, false});
    field(self.sinusoid, {"sinusoid", "", "kind sinusoid", {}, false});
    field(self.block_transfer, {"block_transfer", "", "kind block_transfer", {}, false});
    field(self.recorded, {"recorded", "", "kind recorded", {}, false});
    field(self.hard_stop, {"hard_stop", "", "kind hard_stop", {}, false});
  }
};

/// The trajectory of `spec` for `robot`; `seed` chooses the surgeon of a block transfer. Throws
/// base::InputError when it would leave the joint limits, exceed a joint's highest speed, or its file is
/// unusable.
std::unique_ptr<Trajectory> makeTrajectory(const TrajectorySpec& spec, const robot::Description& robot,
                                           std::uint64_t seed);

/// Minimum-jerk (quintic) move between two rests: x(s) = a + (b − a)(10 s³ − 15 s⁴ + 6 s⁵), s = t / T.
/// Flash and Hogan, J. Neurosci. 5 (1985). Returns {progress in [0, 1], its rate [1/s]}.
inline std::pair<double, double> minimumJerk(double t, double duration) {
  if (t <= 0.0) return {0.0, 0.0};
  if (t >= duration) return {1.0, 0.0};
  const double s = t / duration;
  return {s * s * s * (10.0 - 15.0 * s + 6.0 * s * s), 30.0 * s * s * (1.0 - s) * (1.0 - s) / duration};
}

/// Time of a joint-space quintic from `from` to `to` that keeps each joint below half a radian (a tenth of a
/// metre) a second and lasts at least half a second [s].
double quinticDuration(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace capstan::simulation

template <>
struct capstan::base::NamesOf<capstan::simulation::TrajectoryKind> {
  using K = capstan::simulation::TrajectoryKind;
  static constexpr std::array value = {std::pair{K::kHold, "hold"}, std::pair{K::kSinusoid, "sinusoid"},
                                       std::pair{K::kBlockTransfer, "block_transfer"},
                                       std::pair{K::kRecorded, "recorded"},
                                       std::pair{K::kHardStop, "hard_stop"}};
};
