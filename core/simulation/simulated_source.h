#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/robot/description.h"
#include "core/simulation/stereo_cameras.h"
#include "core/simulation/trajectory.h"
#include "core/simulation/truth.h"
#include "core/tracking/source.h"
#include "core/vision/camera.h"

namespace capstan::simulation {

struct SimulatedOptions {
  robot::Description robot;  ///< nominal: plant = this, its effects + truth
  Truth truth = defaultTruth();
  TrajectorySpec trajectory;
  std::uint64_t seed = 1;                ///< surgeon, noise, texture: same seed, same bytes
  std::optional<vision::StereoRig> rig;  ///< absent: no cameras at all
  bool images = true;                    ///< false: TipSample by triangulating noisy pixels, no pictures
  /// Register at the hard stop before t = 0 with the real detector and triangulator, so that info() carries
  /// base_from_camera. False: the user does it (driveToHardStop). Always done when images are off.
  bool registered = true;
  int registration_frames = 30;
  int joint_decimation = 1;                 ///< a JointSample every so many milliseconds; 0: none
  static constexpr int kFrameBuffers = 16;  ///< pictures in flight before a new one is allocated
};

/// A RAVEN-II that is not there: plant, encoders, 1 kHz controller, trajectory and cameras as a Source.
/// Effects in the robot file act in the plant, time counted from the first sample; encoder_slip on what the
/// encoders measure, the cameras' on every exposure, but not on the registration that is made before.
/// MotorSample (and JointSample) at 1 kHz; StereoFrame at the camera's rate, delivered when it arrives. Ends
/// when the trajectory has. The commands and block() may come from any thread while another calls next().
class SimulatedSource final : public tracking::Source {
 public:
  /// Throws base::InputError for a robot that is no three-joint remote-centre arm or an unusable trajectory.
  explicit SimulatedSource(SimulatedOptions options);
  ~SimulatedSource() override;

  const tracking::SourceInfo& info() const override;
  bool next(tracking::Sample& out) override;
  void block(bool left, bool right) override;

  /// Slows down along the path, then goes to q_hs on a quintic and stays there.
  void driveToHardStop();
  /// Slows down along the path and stays.
  void hold();
  /// Back to where the path was left, and on along it.
  void resume();
  /// At rest at the hard stop.
  bool arrivedAtHardStop() const;

  /// True pose of the left camera in frame 0: what registration tries to find.
  const Eigen::Isometry3d& trueBaseFromCamera() const;
  const FrameTruth& frameTruth() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capstan::simulation
