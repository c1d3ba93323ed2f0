#include "core/simulation/simulated_source.h"

#include <atomic>
#include <mutex>

#include "core/base/yaml.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/chain/chain_law.h"
#include "core/robot/chain/chain_model.h"
#include "core/simulation/camera_mounting.h"
#include "core/simulation/commander.h"
#include "core/simulation/controller.h"
#include "core/simulation/encoder.h"
#include "core/simulation/plant.h"
#include "core/vision/marker.h"

namespace capstan::simulation {
namespace {

constexpr double kTick = 1e-3;      // [s]
constexpr int kSettleTicks = 1000;  // ticks at rest before the first measurement

}  // namespace

struct SimulatedSource::Parts {
  explicit Parts(SimulatedOptions chosen);

  void settleAt(const Eigen::Vector3d& joints);
  void control(const JointTarget& target);
  void advance();
  void exposeDue();
  ToolPose toolAt(const Eigen::Vector3d& q, const Eigen::Vector3d& dq) const;
  std::optional<ToolPose> commandedOf(const ToolPose& tool) const;
  Eigen::Vector3d slipped(double t) const;
  void readEncoders();
  bool jointDue() const { return options.joint_decimation > 0 && tick % options.joint_decimation == 0; }
  tracking::MotorSample motorSample() const;
  tracking::JointSample jointSample() const;

  SimulatedOptions options;
  tracking::SourceInfo info;
  robot::ArmKinematics kinematics;
  std::optional<robot::ChainModel> effects;  // effects of the robot file
  std::unique_ptr<Trajectory> trajectory;
  Plant plant;
  MotorEncoders encoders;
  MotorController controller;
  Commander commander;
  Eigen::Isometry3d base_from_camera;
  std::optional<StereoCameras> cameras;

  std::int64_t tick = 0;
  double now = 0.0;        // [s]
  PlantState before;       // state one tick ago
  Eigen::Vector3d torque;  // motor torque until the next tick [N·m]
  bool motor_due = true, joint_due = true;
  std::atomic<MotionCommand> command{MotionCommand::kRun};
  std::mutex motion_mutex;
  std::shared_ptr<const Trajectory> motion;  // of the command kMotion; motion_mutex protects it
  std::atomic<bool> arrived{false}, block_left{false}, block_right{false};
};

SimulatedSource::Parts::Parts(SimulatedOptions chosen)
    : options(std::move(chosen)),
      kinematics(options.robot),
      trajectory(makeTrajectory(options.trajectory, options.robot, options.seed)),
      plant(options.robot, options.truth),
      encoders(options.robot, options.truth.encoders, kTick),
      controller(options.robot, options.truth.controller),
      commander(*trajectory, robot::homingOf(options.robot)),
      base_from_camera(simulation::trueBaseFromCamera(options.robot, options.truth.cameras)) {
  if (!options.robot.effects.empty()) effects.emplace(options.robot);
  info.title = "simulated " + options.robot.name;
  info.robot = options.robot;
  info.truth = formatTruth(options.truth);
  info.marker = base::writeYaml(vision::MarkerOptions{});
  info.duration = trajectory->duration();
  info.reference = options.joint_decimation > 0;
  info.live = true;
  if (options.rig) {
    SceneSizes sizes;
    sizes.marker_radius = options.robot.marker_radius;
    Truth truth = options.truth;
    if (effects) truth.cameras.stamp_delay += effects->camera.delay;
    cameras.emplace(*options.rig, base_from_camera, sizes, truth, options.images,
                    SimulatedOptions::kFrameBuffers, options.seed);
    if (options.images) info.rig = options.rig;
    if (options.registered || !options.images) {
      settleAt(robot::homingOf(options.robot));
      info.base_from_camera = cameras->registerAtRest(
          toolAt(plant.state().q_link, Eigen::Vector3d::Zero()), nominalBaseFromCamera(options.robot),
          kinematics.tip(robot::homingOf(options.robot)), options.registration_frames);
      cameras->setRegistration(*info.base_from_camera);
    }
  }
  settleAt(trajectory->at(0.0).position);
  joint_due = jointDue();
}

/// Slip of the encoders against the motors at `t` [rad].
Eigen::Vector3d SimulatedSource::Parts::slipped(double t) const {
  Eigen::Vector3d slip = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i)
    if (effects->shape.laws[i] & robot::kLawSlip) slip[i] = robot::slipAt(effects->numbers.joints[i], t);
  return slip;
}

void SimulatedSource::Parts::readEncoders() {
  const PlantState& state = plant.state();
  if (!effects) return encoders.read(state.q_motor, state.dq_motor);
  const Eigen::Vector3d slip = slipped(now);
  encoders.read(state.q_motor - slip, state.dq_motor - (slip - slipped(now - kTick)) / kTick);
}

void SimulatedSource::Parts::control(const JointTarget& target) {
  readEncoders();
  torque = controller.torque(target, encoders);
}

void SimulatedSource::Parts::settleAt(const Eigen::Vector3d& joints) {
  const JointTarget target{joints, Eigen::Vector3d::Zero()};
  plant.reset(controller.motorsFor(joints), kSettleTicks * kTick);
  encoders.reset(plant.state().q_motor);
  for (int i = 0; i < kSettleTicks; ++i) {
    control(target);
    plant.step(torque, kTick);
  }
  control(target);
  before = plant.state();
}

ToolPose SimulatedSource::Parts::toolAt(const Eigen::Vector3d& q, const Eigen::Vector3d& dq) const {
  return {kinematics.tip(q), kinematics.tipJacobian(q) * dq, kinematics.frame(3, q).linear().col(2)};
}

/// Pose of the tool as measured by cameras with the errors that the robot file declares.
std::optional<ToolPose> SimulatedSource::Parts::commandedOf(const ToolPose& tool) const {
  if (!effects) return std::nullopt;
  const robot::CameraNumbers& camera = effects->camera;
  const Eigen::Vector3d origin = camera.measure(Eigen::Vector3d::Zero());
  return ToolPose{camera.measure(tool.tip), camera.measure(tool.velocity) - origin,
                  (camera.measure(tool.axis) - origin).normalized()};
}

void SimulatedSource::Parts::advance() {
  before = plant.state();
  plant.step(torque, kTick);
  now = static_cast<double>(++tick) * kTick;
  exposeDue();
  const MotionCommand commanded = command.load(std::memory_order_acquire);
  if (commanded == MotionCommand::kMotion) {
    const std::lock_guard lock(motion_mutex);
    commander.setMotion(motion);
  }
  commander.command(commanded);
  control(commander.step(kTick));
  MotionCommand done = MotionCommand::kMotion;
  if (commander.motionDone()) command.compare_exchange_strong(done, MotionCommand::kRun);
  arrived.store(commander.atHardStop(), std::memory_order_relaxed);
  motor_due = true;
  joint_due = jointDue();
}

void SimulatedSource::Parts::exposeDue() {
  while (cameras && cameras->nextExposure() <= now) {
    const double t = cameras->nextExposure(), share = 1.0 - (now - t) / kTick;
    const PlantState& after = plant.state();
    const Eigen::Vector3d q = before.q_link + share * (after.q_link - before.q_link);
    const Eigen::Vector3d dq = before.dq_link + share * (after.dq_link - before.dq_link);
    const ToolPose tool = toolAt(q, dq);
    cameras->expose({t, q, tool, {block_left.load(), block_right.load()}, commandedOf(tool)});
  }
}

tracking::MotorSample SimulatedSource::Parts::motorSample() const {
  return {now, encoders.position(), encoders.velocity(), torque};
}

tracking::JointSample SimulatedSource::Parts::jointSample() const {
  const Eigen::Vector3d &q = plant.state().q_link, &step = options.truth.encoders.joint_resolution;
  return {now, {quantised(q[0], step[0]), quantised(q[1], step[1]), quantised(q[2], step[2])}};
}

SimulatedSource::SimulatedSource(SimulatedOptions options)
    : parts_(std::make_unique<Parts>(std::move(options))) {}
SimulatedSource::~SimulatedSource() = default;

const tracking::SourceInfo& SimulatedSource::info() const { return parts_->info; }

bool SimulatedSource::next(tracking::Sample& out) {
  Parts& parts = *parts_;
  while (true) {
    if (parts.cameras && parts.cameras->deliver(parts.now, out)) return true;
    if (parts.motor_due) {
      parts.motor_due = false;
      out = parts.motorSample();
      return true;
    }
    if (parts.joint_due) {
      parts.joint_due = false;
      out = parts.jointSample();
      return true;
    }
    if (parts.commander.finished()) return false;
    parts.advance();
  }
}

void SimulatedSource::block(bool left, bool right) {
  parts_->block_left = left;
  parts_->block_right = right;
}

void SimulatedSource::driveToHardStop() { parts_->command = MotionCommand::kHardStop; }
void SimulatedSource::drive(const TrajectorySpec& motion) {
  std::shared_ptr<const Trajectory> made =
      makeTrajectory(motion, parts_->options.robot, parts_->options.seed);
  {
    const std::lock_guard lock(parts_->motion_mutex);
    parts_->motion = std::move(made);
  }
  parts_->command = MotionCommand::kMotion;
}
void SimulatedSource::hold() { parts_->command = MotionCommand::kHold; }
void SimulatedSource::resume() { parts_->command = MotionCommand::kRun; }
bool SimulatedSource::arrivedAtHardStop() const { return parts_->arrived; }

const Eigen::Isometry3d& SimulatedSource::trueBaseFromCamera() const { return parts_->base_from_camera; }
const FrameTruth& SimulatedSource::frameTruth() const {
  static const FrameTruth none;
  return parts_->cameras ? parts_->cameras->delivered() : none;
}

}  // namespace capstan::simulation
