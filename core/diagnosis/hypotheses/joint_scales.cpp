#include "core/diagnosis/hypotheses/joint_scales.h"

#include <algorithm>
#include <cmath>

#include "core/robot/chain/chain_bodies.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain/chain_state.h"

namespace capstan::diagnosis {
namespace {

/// Position of a joint at a row: its encoder's, or else that of the motors with rigid cables.
double positionAt(const Evidence& e, const robot::ChainModel& model, int joint, std::size_t row) {
  const auto at = static_cast<std::size_t>(joint);
  if (e.hasEncoders()) return e.q[at][row];
  robot::JointVector q_m(e.joints);
  for (int j = 0; j < e.joints; ++j) q_m[j] = e.q_m.empty() ? 0.0 : e.q_m[static_cast<std::size_t>(j)][row];
  return robot::jointsFromMotors(model, q_m)[joint];
}

double topSpeed(const std::vector<Evidence>& recordings, const robot::ChainModel& model, int joint) {
  std::vector<double> speeds;
  for (const Evidence& e : recordings) {
    const auto reach = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(0.02 / e.step)));
    for (const Segment& segment : e.segments)
      for (std::size_t k = segment.begin; k + reach < segment.end; k += reach) {
        const double way = positionAt(e, model, joint, k + reach) - positionAt(e, model, joint, k);
        if (std::isfinite(way)) speeds.push_back(std::abs(way) / (static_cast<double>(reach) * e.step));
      }
  }
  if (speeds.empty()) return 0.0;
  const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), at, speeds.end());
  return *at;
}

/// Largest measured load of a joint; 0: loads are not measured.
double largestLoad(const std::vector<Evidence>& recordings, int joint) {
  double most = 0.0;
  for (const Evidence& e : recordings) {
    if (e.tau_ext.empty()) continue;
    for (const double load : e.tau_ext[static_cast<std::size_t>(joint)])
      if (std::isfinite(load)) most = std::max(most, std::abs(load));
  }
  return most;
}

}  // namespace

std::vector<JointScales> jointScales(const std::vector<Evidence>& recordings,
                                     const robot::Description& robot) {
  const robot::ChainModel model(robot);
  double middle[robot::kChainJoints] = {}, still[robot::kChainJoints] = {};
  for (int i = 0; i < robot.size(); ++i) middle[i] = model.shape.middle[i];
  robot::ChainBodies<double> bodies;
  robot::chainBodies<double>(model.shape, model.numbers, middle, still, bodies);
  std::vector<JointScales> all;
  for (int i = 0; i < robot.size(); ++i) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const robot::Drive& drive = robot.drives[static_cast<std::size_t>(i)];
    JointScales s;
    s.range = joint.limit_high - joint.limit_low;
    s.speed = topSpeed(recordings, model, i);
    if (!(s.speed > 0.0)) s.speed = joint.max_speed;
    s.coulomb = joint.friction.coulomb;
    s.viscous = joint.friction.viscous;
    s.inertia = bodies.mass[i][i];
    s.radius = drive.link_radius;
    s.capstan = drive.motor_capstan_radius;
    s.gear = drive.gear_ratio;
    s.load = largestLoad(recordings, i);
    if (!model.shape.rigid) {
      s.stiffness = 2.0 * drive.cable_stiffness * drive.cable_exponent;
      s.stretch = (std::abs(bodies.bias[i]) + 2.0 * s.coulomb) / s.radius / s.stiffness;
    }
    for (const Evidence& e : recordings) s.duration = std::max(s.duration, e.duration());
    s.joints = robot.size();
    for (int j = 0; j < robot.size(); ++j)
      if (j != i && model.numbers.coupling[j][i] != 0.0) s.moves_other_cables = true;
    all.push_back(s);
  }
  return all;
}

}  // namespace capstan::diagnosis
