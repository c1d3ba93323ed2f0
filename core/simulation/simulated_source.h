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

/// What a simulation consists of.
struct SimulatedOptions {
  robot::Description robot;  ///< nominal robot; the plant adds its effects and the truth
  Truth truth = defaultTruth();
  TrajectorySpec trajectory;
  std::uint64_t seed = 1;                ///< seed of surgeon, noise and texture: same seed, same bytes
  std::optional<vision::StereoRig> rig;  ///< stereo cameras; absent: none
  bool images = true;                    ///< false: TipSample by triangulation of noisy pixels, no images
  /// True: the cameras are registered at the hard stop before t = 0, with the real detector and triangulator,
  /// and info() has base_from_camera. False: the user registers (driveToHardStop). Without images: always
  /// registered.
  bool registered = true;
  int registration_frames = 30;             ///< number of frames of that registration
  int joint_decimation = 1;                 ///< milliseconds between JointSamples; 0: none
  static constexpr int kFrameBuffers = 16;  ///< image pairs in flight before a new one is allocated
};

/// A simulated RAVEN-II as a Source: plant, encoders, 1 kHz controller, trajectory and cameras. Effects of
/// the robot file act in the plant; their time counts from the first sample. The effect encoder_slip acts on
/// encoder measurements. Camera effects act on every exposure, but not on the registration before t = 0.
/// next() gives MotorSample (and JointSample) at 1 kHz and StereoFrame at the camera rate, when it arrives.
/// The source ends with the trajectory. Any thread may send commands or call block() while another calls
/// next().
class SimulatedSource final : public tracking::Source {
 public:
  /// Throws base::InputError when the robot is not a three-joint remote-centre arm or the trajectory is
  /// unusable.
  explicit SimulatedSource(SimulatedOptions options);
  ~SimulatedSource() override;

  const tracking::SourceInfo& info() const override;
  bool next(tracking::Sample& out) override;
  void block(bool left, bool right) override;

  /// Slows down along the path, then moves to the hard stop q_hs on a quintic and stays there.
  void driveToHardStop();
  /// Slows down along the path to a halt.
  void hold();
  /// Slows down along the path, moves to the start of another motion, follows it, and returns to the path,
  /// which it continues. Throws base::InputError as makeTrajectory().
  void drive(const TrajectorySpec& motion);
  /// Returns to the point where the path was left and continues along it.
  void resume();
  /// True while the arm rests at the hard stop.
  bool arrivedAtHardStop() const;

  /// True pose of the left camera in frame 0; registration estimates it.
  const Eigen::Isometry3d& trueBaseFromCamera() const;
  /// Truth of the frame that was delivered last.
  const FrameTruth& frameTruth() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capstan::simulation
