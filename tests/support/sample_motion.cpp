#include "tests/support/sample_motion.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/robot/arm_kinematics.h"

namespace capstan::testing {

namespace {

using diagnosis::Columns;
using diagnosis::Evidence;
using diagnosis::SimulatedMotion;
using diagnosis::Verdict;

constexpr double kStep = 0.01, kTurn = 2.0 * std::numbers::pi;
constexpr std::array kNoise = {4e-4, 4e-4, 8e-5};  // of the joint encoders [rad, rad, m]

/// Two sines in the middle of the joint's range, and their first two derivatives.
std::array<double, 3> motionAt(const robot::Joint& joint, std::size_t j, int recording, double t) {
  const double centre = 0.5 * (joint.limit_low + joint.limit_high);
  const double half = 0.3 * (joint.limit_high - joint.limit_low);
  std::array<double, 3> motion = {centre, 0.0, 0.0};
  for (const auto& [share, hertz] :
       {std::pair{0.7, 0.11 + 0.03 * static_cast<double>(j) + 0.02 * recording},
        std::pair{0.3, 0.37 + 0.05 * static_cast<double>(j) + 0.04 * recording}}) {
    const double w = kTurn * hertz, phase = w * t + static_cast<double>(j);
    motion[0] += share * half * std::sin(phase);
    motion[1] += share * half * w * std::cos(phase);
    motion[2] -= share * half * w * w * std::sin(phase);
  }
  return motion;
}

/// What is measured beyond the extended model.
double hidden(const SampleDiagnosis& sample, const robot::Description& robot, std::size_t j, double q,
              double v, double motor, double t) {
  const robot::Drive& drive = robot.drives[j];
  const bool backlash = sample.verdict == Verdict::kFound || sample.verdict == Verdict::kSeveral ||
                        sample.verdict == Verdict::kTie;
  double e = 0.0;
  if (backlash && j == 1) e -= kSampleBacklash / drive.link_radius * std::tanh(v / 0.02);
  if (sample.verdict == Verdict::kSeveral && j == 0)
    e += kSampleEccentricity / drive.link_radius * std::sin(motor / drive.gear_ratio);
  if (sample.verdict == Verdict::kUnexplained && j == 2) e += 4e-4 * std::sin(kTurn * kSampleVibration * t);
  if (sample.verdict == Verdict::kUnexplained && j == 0) e += 6e-3 * std::sin(9.0 * q);
  return e;
}

Evidence emptyEvidence(const SampleDiagnosis& sample, int recording) {
  Evidence evidence;
  evidence.title = recording == 0 ? "slow.csv" : "fast" + std::to_string(recording) + ".csv";
  evidence.file = evidence.title;
  evidence.joints = 3;
  evidence.step = kStep;
  const auto rows = static_cast<std::size_t>(std::lround(sample.duration / kStep));
  for (std::size_t i = 0; i < rows; ++i) evidence.t.push_back(kStep * static_cast<double>(i));
  evidence.segments = {{0, rows}};
  evidence.exclusions.assign(rows, 0);
  for (Columns* columns : {&evidence.q_m, &evidence.dq_m, &evidence.tau_m, &evidence.q})
    columns->assign(3, std::vector<double>(rows));
  evidence.noise.q.resize(3);
  for (std::size_t j = 0; j < 3; ++j) evidence.noise.q[j].sigma = kNoise[j];
  return evidence;
}

void fillJoint(const SampleDiagnosis& sample, int recording, const robot::Description& robot, std::size_t j,
               SampleMotion& motion) {
  base::Random random(sample.seed, "sample " + std::to_string(10 * recording + static_cast<int>(j)));
  const robot::Drive& drive = robot.drives[j];
  const robot::Joint& joint = robot.joints[j];
  double slow = 0.0;  // a little of everything that no model has
  for (std::size_t i = 0; i < motion.evidence.rows(); ++i) {
    const double t = motion.evidence.t[i];
    const auto [q, v, a] = motionAt(joint, j, recording, t);
    const double turns = drive.gear_ratio * drive.link_radius / drive.motor_capstan_radius;
    const double motor = turns * (q - joint.homing);
    const double torque = joint.link.mass * (0.05 * a + 0.8 * std::sin(q)) +
                          joint.friction.coulomb * std::tanh(v / joint.friction.smoothing);
    slow = 0.98 * slow + random.normal(0.0, 0.1 * kNoise[j]);
    motion.evidence.q_m[j][i] = motor;
    motion.evidence.dq_m[j][i] = turns * v;
    motion.evidence.tau_m[j][i] = torque / turns;
    motion.extended.q[j][i] = q;
    motion.refitted.q[j][i] = q;
    motion.nominal.q[j][i] = q + 6.0 * kNoise[j] * torque;  // too soft a cable
    for (SimulatedMotion* model : {&motion.nominal, &motion.refitted, &motion.extended}) {
      model->dq[j][i] = v, model->ddq[j][i] = a;
      model->tau[j][i] = torque, model->stretch[j][i] = 2e-4 * torque;
    }
    const double effect = hidden(sample, robot, j, q, v, motor, t);
    motion.extended.q[j][i] += sample.verdict == Verdict::kUnexplained ? 0.0 : effect;
    motion.evidence.q[j][i] = q + effect + slow + random.normal(0.0, kNoise[j]);
  }
}

Eigen::Vector3d tipAt(const robot::ArmKinematics& arm, const Columns& q, std::size_t row) {
  return arm.tip({q[0][row], q[1][row], q[2][row]});
}

/// Fifteen times a second, half a millimetre of noise.
void fillTips(const SampleDiagnosis& sample, int recording, const robot::Description& robot,
              SampleMotion& motion) {
  const robot::ArmKinematics arm(robot);
  base::Random random(sample.seed, "sample tips " + std::to_string(recording));
  constexpr double kSigma = 5e-4;
  for (auto& noise : motion.evidence.noise.tip) noise.sigma = kSigma;
  for (std::size_t row = 3; row < motion.evidence.rows(); row += 7) {
    Eigen::Vector3d seen = tipAt(arm, motion.evidence.q, row);
    for (int axis = 0; axis < 3; ++axis) seen(axis) += random.normal(0.0, kSigma);
    motion.evidence.tip.push_back({motion.evidence.t[row], static_cast<double>(row), seen, true});
    for (SimulatedMotion* model : {&motion.nominal, &motion.refitted, &motion.extended})
      model->tip.push_back(tipAt(arm, model->q, row));
  }
}

}  // namespace

SampleMotion sampleMotion(const SampleDiagnosis& sample, int recording, const robot::Description& robot) {
  SampleMotion motion;
  motion.evidence = emptyEvidence(sample, recording);
  motion.evidence.robot = robot;
  for (SimulatedMotion* model : {&motion.nominal, &motion.refitted, &motion.extended})
    for (Columns* columns : {&model->q, &model->dq, &model->ddq, &model->tau, &model->stretch})
      columns->assign(3, std::vector<double>(motion.evidence.rows()));
  for (std::size_t j = 0; j < 3; ++j) fillJoint(sample, recording, robot, j, motion);
  if (sample.cameras) fillTips(sample, recording, robot, motion);
  return motion;
}

}  // namespace capstan::testing
