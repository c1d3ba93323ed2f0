#include "core/diagnosis/experiment_design/motion_evidence.h"

#include <cmath>

#include "core/robot/kinematics.h"
#include "core/robot/transmission.h"

namespace capstan::diagnosis {
namespace {

Columns columnsOf(const std::vector<robot::JointVector>& rows, int joints) {
  Columns columns(static_cast<std::size_t>(joints));
  for (const robot::JointVector& row : rows)
    for (int j = 0; j < joints; ++j) columns[static_cast<std::size_t>(j)].push_back(row[j]);
  return columns;
}

std::vector<TipObservation> tipsOf(const TestMotion& motion, const robot::Description& nominal) {
  const robot::Chain chain(nominal);
  std::vector<TipObservation> tips;
  const double rows = 1.0 / (kCameraRate * motion.step);
  for (double row = 0.0; row < static_cast<double>(motion.q.size() - 1); row += rows) {
    const auto at = static_cast<std::size_t>(std::lround(row));
    tips.push_back(
        {static_cast<double>(at) * motion.step, static_cast<double>(at), chain.marker(motion.q[at])});
  }
  return tips;
}

}  // namespace

Evidence motionEvidence(const TestMotion& motion, const robot::Description& nominal, const Evidence& like) {
  const robot::Transmission transmission(nominal);
  std::vector<robot::JointVector> q_m, dq_m;
  for (const robot::JointVector& q : motion.q) q_m.push_back(transmission.motorFromJoint(q));
  for (const robot::JointVector& dq : motion.dq) dq_m.push_back(transmission.motorVelocityFromJoint(dq));
  Evidence evidence;
  evidence.title = motion.title;
  evidence.drive = DriveKind::kCable;
  evidence.joints = nominal.size();
  evidence.step = motion.step;
  for (std::size_t k = 0; k < motion.q.size(); ++k)
    evidence.t.push_back(motion.step * static_cast<double>(k));
  evidence.segments = {{0, motion.q.size()}};
  evidence.q_m = columnsOf(q_m, nominal.size());
  evidence.dq_m = columnsOf(dq_m, nominal.size());
  if (like.hasEncoders()) evidence.q = columnsOf(motion.q, nominal.size());
  if (like.hasCameras()) evidence.tip = tipsOf(motion, nominal);
  evidence.exclusions.assign(motion.q.size(), 0);
  evidence.noise = like.noise;
  return evidence;
}

}  // namespace capstan::diagnosis
