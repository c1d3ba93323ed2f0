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

/// Desired joints at one instant.
struct JointTarget {
  Eigen::Vector3d position;  ///< joint positions [rad, rad, m]
  Eigen::Vector3d velocity;  ///< joint velocities [rad/s, rad/s, m/s]
};

/// Smooth motion of the first three joints, a pure function of time. Nothing is allocated.
class Trajectory {
 public:
  virtual ~Trajectory() = default;
  /// Desired joints at t [s]. Before 0 and after duration(): the end points, at rest.
  virtual JointTarget at(double t) const = 0;
  virtual double duration() const = 0;  ///< [s]
  /// Next instant after t [s] at which limits and speeds are checked. Steps are so dense that no extreme is
  /// missed by more than about a per cent, yet few enough for a session of a day.
  virtual double nextInstant(double t) const { return t + kDenseStep; }

 protected:
  static constexpr double kDenseStep = 5e-3;  ///< [s]
};

enum class TrajectoryKind { kHold, kSinusoid, kBlockTransfer, kRecorded, kHardStop };

/// Joints held at one position.
struct HoldSpec {
  Eigen::Vector3d position{base::toRadians(35.0), base::toRadians(90.0), 0.33};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.position, {"position", "rad, rad, m", "joints to hold", {-10.0, 10.0}, false});
  }
};

/// Sinusoid per joint: q_i(t) = centre_i + amplitude_i sin(2 pi frequency_i t) · ramp(t). The ramp takes two
/// seconds at each end.
struct SinusoidSpec {
  Eigen::Vector3d centre{base::toRadians(40.0), base::toRadians(90.0), 0.32};
  Eigen::Vector3d amplitude{base::toRadians(25.0), base::toRadians(25.0), 0.05};
  Eigen::Vector3d frequency{0.11, 0.17, 0.23};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.centre, {"centre", "rad, rad, m", "middle of the oscillation", {-10.0, 10.0}, false});
    field(self.amplitude, {"amplitude", "rad, rad, m", "amplitude of each joint", {0.0, 10.0}, false});
    field(self.frequency, {"frequency", "Hz", "frequency of each joint", {0.0, 5.0}, false});
  }
};

/// FLS block transfer (block_transfer.h). Path, tempo, pauses and tremor differ from seed to seed.
struct BlockTransferSpec {
  /// Joints with the tip on the middle of the peg board [rad, rad, m].
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

/// A joint trajectory from a CSV table with the columns t, q1, q2, q3 (SI); other columns are ignored.
struct RecordedSpec {
  std::string file;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.file, {"file", "", "CSV with the columns t, q1, q2, q3", {}, false});
  }
};

/// Motion from `start` to the hard stop q_hs and, after a rest, back; both ways are quintics.
struct HardStopSpec {
  Eigen::Vector3d start{base::toRadians(35.0), base::toRadians(90.0), 0.33};
  double rest = 3.0;  ///< time at the hard stop [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.start, {"start", "rad, rad, m", "joints at start and end", {-10.0, 10.0}, false});
    field(self.rest, {"rest", "s", "time spent at the hard stop", {0.0, 600.0}, false});
  }
};

/// Kind and duration of a trajectory, and the parameters of each kind.
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
    field(self.hold, {"hold", "", "parameters of kind hold", {}, false});
    field(self.sinusoid, {"sinusoid", "", "parameters of kind sinusoid", {}, false});
    field(self.block_transfer, {"block_transfer", "", "parameters of kind block_transfer", {}, false});
    field(self.recorded, {"recorded", "", "parameters of kind recorded", {}, false});
    field(self.hard_stop, {"hard_stop", "", "parameters of kind hard_stop", {}, false});
  }
};

/// Returns the trajectory of `spec` for `robot`; `seed` determines the surgeon of a block transfer. Throws
/// base::InputError when the trajectory leaves the joint limits or exceeds the highest speed of a joint, or
/// when its file is unusable.
std::unique_ptr<Trajectory> makeTrajectory(const TrajectorySpec& spec, const robot::Description& robot,
                                           std::uint64_t seed);

/// Minimum-jerk (quintic) motion from rest to rest: x(s) = a + (b − a)(10 s³ − 15 s⁴ + 6 s⁵), s = t / T.
/// Flash and Hogan, J. Neurosci. 5 (1985). Returns {progress in [0, 1], its rate [1/s]}.
inline std::pair<double, double> minimumJerk(double t, double duration) {
  if (t <= 0.0) return {0.0, 0.0};
  if (t >= duration) return {1.0, 0.0};
  const double s = t / duration;
  return {s * s * s * (10.0 - 15.0 * s + 6.0 * s * s), 30.0 * s * s * (1.0 - s) * (1.0 - s) / duration};
}

/// Duration [s] of a joint-space quintic from `from` to `to` that keeps each joint below 0.5 rad/s (0.1 m/s);
/// at least 0.5 s.
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
