#include "core/diagnosis/residuals/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/diagnosis/evidence/smooth_derivative.h"
#include "core/robot/transmission.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kHalfWindow = 0.01;  // half width of the window of derivatives [s]

Columns derivatives(const Evidence& evidence, const Columns& columns) {
  const auto half =
      std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(kHalfWindow / evidence.step)));
  Columns result(columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (const Segment& segment : evidence.segments) {
      const std::vector<double> slope =
          smoothDerivative(std::span(columns[j]).subspan(segment.begin, segment.size()), evidence.step, half);
      result[j].insert(result[j].end(), slope.begin(), slope.end());
    }
  return result;
}

Columns directions(const Columns& velocity) {
  Columns result;
  for (const std::vector<double>& v : velocity) {
    std::vector<double> moving;
    for (const double x : v)
      if (x != 0.0) moving.push_back(std::abs(x));
    const double rest = moving.empty() ? 0.0 : kRest * stats::quantile(moving, 0.95);
    std::vector<double>& sign = result.emplace_back();
    for (const double x : v) sign.push_back(std::abs(x) <= rest ? 0.0 : x > 0.0 ? 1.0 : -1.0);
  }
  return result;
}

/// Motor positions: measured ones, or else those of the simulated joints.
Columns motorPositions(const Evidence& evidence, const SimulatedMotion& simulated,
                       const robot::Description& robot) {
  if (!evidence.q_m.empty() || robot.drives.size() != simulated.q.size()) return evidence.q_m;
  const robot::Transmission transmission(robot);
  const auto n = static_cast<Eigen::Index>(simulated.q.size());
  Columns result(simulated.q.size(), std::vector<double>(evidence.rows()));
  for (std::size_t row = 0; row < evidence.rows(); ++row) {
    robot::JointVector q(n);
    for (Eigen::Index j = 0; j < n; ++j) q(j) = simulated.q[static_cast<std::size_t>(j)][row];
    const robot::JointVector q_m = transmission.motorFromJoint(q);
    for (Eigen::Index j = 0; j < n; ++j) result[static_cast<std::size_t>(j)][row] = q_m(j);
  }
  return result;
}

Columns capstanAngles(Columns motors, const robot::Description& robot) {
  if (robot.drives.size() != motors.size()) return {};
  for (std::size_t j = 0; j < motors.size(); ++j) {
    if (robot.drives[j].gear_ratio == 1.0) motors[j].clear();  // the motor's own angle
    for (double& x : motors[j]) x /= robot.drives[j].gear_ratio;
  }
  return motors;
}

/// Collects the variables that change and are finite.
class Collector {
 public:
  explicit Collector(const robot::Description& robot) : robot_(robot) {}

  void add(VariableKind kind, const char* what, const char* turning, const char* sliding,
           const Columns& columns, double period = 0.0) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (!usable(columns[j])) continue;
      const bool turns = robot_.joints[j].type == robot::JointType::kRevolute;
      variables_.push_back({kind, static_cast<int>(j) + 1, fmt::format("{} of joint {}", what, j + 1),
                            turns ? turning : sliding, period, columns[j]});
    }
  }
  void addTime(const Evidence& evidence) {
    std::vector<double> passed(evidence.t);
    for (double& t : passed) t -= evidence.t.front();
    if (usable(passed)) variables_.push_back({VariableKind::kTime, 0, "time", "s", 0.0, std::move(passed)});
  }
  std::vector<Variable> take() { return std::move(variables_); }

 private:
  static bool usable(const std::vector<double>& values) {
    if (values.empty()) return false;
    double low = values.front(), high = values.front();
    for (const double x : values) {
      if (!std::isfinite(x)) return false;
      low = std::min(low, x), high = std::max(high, x);
    }
    return low < high;
  }

  const robot::Description& robot_;
  std::vector<Variable> variables_;
};

}  // namespace

std::vector<double> Variable::at(const Channel& channel) const {
  std::vector<double> result;
  result.reserve(channel.size());
  for (const double row : channel.row) {
    const double value = kind == VariableKind::kDirection
                             ? values[std::min(static_cast<std::size_t>(std::lround(row)), values.size() - 1)]
                             : Evidence::at(values, row);
    result.push_back(period > 0.0 ? value - period * std::floor(value / period) : value);
  }
  return result;
}

std::vector<Variable> variablesOf(const Evidence& evidence, const SimulatedMotion& simulated,
                                  const robot::Description& robot) {
  const Columns velocity = simulated.dq.empty() ? derivatives(evidence, simulated.q) : simulated.dq;
  const Columns motors = motorPositions(evidence, simulated, robot);
  Collector all(robot);
  all.add(VariableKind::kPosition, "position", "rad", "m", simulated.q);
  all.add(VariableKind::kDirection, "direction", "", "", directions(velocity));
  all.add(VariableKind::kVelocity, "velocity", "rad/s", "m/s", velocity);
  all.add(VariableKind::kAcceleration, "acceleration", "rad/s^2", "m/s^2",
          simulated.ddq.empty() ? derivatives(evidence, velocity) : simulated.ddq);
  all.add(VariableKind::kMotorTorque, "motor torque", "N*m", evidence.q_m.empty() ? "N" : "N*m",
          evidence.tau_m);
  all.add(VariableKind::kJointTorque, "joint torque", "N*m", "N", simulated.tau);
  all.add(VariableKind::kLoad, "external load", "N*m", "N", evidence.tau_ext);
  all.add(VariableKind::kMotorAngle, "motor angle", "rad", "rad", motors, kTurn);
  all.add(VariableKind::kCapstanAngle, "capstan angle", "rad", "rad", capstanAngles(motors, robot), kTurn);
  all.add(VariableKind::kStretch, "cable stretch", "m", "m", simulated.stretch);
  all.addTime(evidence);
  return all.take();
}

bool concerns(const Variable& variable, const Channel& channel) {
  if (variable.joint == 0 || variable.joint == channel.joint) return true;
  switch (variable.kind) {
    case VariableKind::kPosition:
    case VariableKind::kDirection:
      return true;
    case VariableKind::kVelocity:
    case VariableKind::kLoad:
      return channel.joint == 0;
    default:
      return false;
  }
}

}  // namespace capstan::diagnosis
