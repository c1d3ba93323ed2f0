#include "core/robot/description.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/check_effects.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {
namespace {

constexpr double kSmallestPivot =
    1e-9;  ///< smallest pivot of an invertible coupling, relative to the largest

std::string at(std::string_view list, std::size_t i, std::string_view key = {}) {
  return key.empty() ? fmt::format("{}[{}]", list, i) : fmt::format("{}[{}].{}", list, i, key);
}

void checkCount(const YAML::Node& root, const std::string& file, const Description& description) {
  const std::size_t n = description.joints.size();
  if (n < 1 || n > static_cast<std::size_t>(kMaxJoints))
    base::refuseYaml(root["joints"], {file, "joints"},
                     fmt::format("has {} joints, allowed are 1 to {}", n, kMaxJoints),
                     "List the driven joints only");
  if (description.drives.size() != n)
    base::refuseYaml(root["drives"], {file, "drives"},
                     fmt::format("has {} drives for {} joints", description.drives.size(), n),
                     "Give each joint one drive, in the same order");
  if (description.wrist.size() > static_cast<std::size_t>(kMaxJoints))
    base::refuseYaml(root["wrist"], {file, "wrist"},
                     fmt::format("has {} rows, allowed are 0 to {}", description.wrist.size(), kMaxJoints));
}

void checkJoint(const YAML::Node& node, const std::string& file, std::size_t i, const Joint& joint) {
  const double range = joint.limit_high - joint.limit_low;
  if (!(range > 0.0))
    base::refuseYaml(node["limit_high"], {file, at("joints", i, "limit_high")},
                     fmt::format("is not above limit_low = {}", joint.limit_low),
                     "Put the lower limit into limit_low");
  const double low = joint.limit_low - ArmKinematics::kLimitMargin * range;
  const double high = joint.limit_high + ArmKinematics::kLimitMargin * range;
  if (joint.homing < low || joint.homing > high)
    base::refuseYaml(
        node["homing"], {file, at("joints", i, "homing")},
        fmt::format("is not within {:.6g} to {:.6g}, the limits widened by {:g} % of their range", low, high,
                    100.0 * ArmKinematics::kLimitMargin),
        "Move the hard stop or the limits");
}

void checkCoupling(const YAML::Node& root, const std::string& file, const Description& description) {
  const YAML::Node coupling = root["coupling"];
  const std::size_t n = description.joints.size();
  if (description.coupling.size() != n)
    base::refuseYaml(coupling, {file, "coupling"},
                     fmt::format("has {} rows for {} joints", description.coupling.size(), n),
                     "Write one row of the matrix A for each joint");
  for (std::size_t row = 0; row < n; ++row) {
    const std::vector<double>& numbers = description.coupling[row];
    if (numbers.size() != n)
      base::refuseYaml(coupling[row], {file, at("coupling", row)},
                       fmt::format("has {} numbers, the matrix is {}x{}", numbers.size(), n, n),
                       "Write one number for each joint");
  }
  Eigen::FullPivLU<JointMatrix> decomposition(couplingMatrix(description));
  decomposition.setThreshold(kSmallestPivot);
  if (!decomposition.isInvertible())
    base::refuseYaml(coupling, {file, "coupling"},
                     "cannot be inverted: motors would not determine the joints",
                     "Check for equal rows and for a zero on the diagonal");
}

}  // namespace

Description parseDescription(const std::string& text, const std::string& name) {
  auto description = base::readYaml<Description>(text, name);
  const YAML::Node root = base::parseYamlText(text, name);
  checkCount(root, name, description);
  for (std::size_t i = 0; i < description.joints.size(); ++i)
    checkJoint(root["joints"][i], name, i, description.joints[i]);
  checkCoupling(root, name, description);
  checkEffects(root, name, description);
  return description;
}

Description readDescription(const std::filesystem::path& path) {
  return parseDescription(base::readYamlTextFile(path), path.string());
}

Description defaultDescription() { return readDescription(base::resource("robots/raven2_left.yaml")); }

Description readDescriptionOrDefault(const std::filesystem::path& path) {
  return path.empty() ? defaultDescription() : readDescription(path);
}

std::string formatDescription(const Description& description) { return base::writeYaml(description); }

JointMatrix couplingMatrix(const Description& description) {
  const auto n = static_cast<Eigen::Index>(description.coupling.size());
  JointMatrix matrix(n, n);
  for (Eigen::Index row = 0; row < n; ++row)
    for (Eigen::Index column = 0; column < n; ++column)
      matrix(row, column) =
          description.coupling[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  return matrix;
}

Eigen::Vector3d homingOf(const Description& description) {
  Eigen::Vector3d q = Eigen::Vector3d::Zero();
  const std::size_t count = std::min<std::size_t>(description.joints.size(), 3);
  for (std::size_t i = 0; i < count; ++i) q(static_cast<Eigen::Index>(i)) = description.joints[i].homing;
  return q;
}

}  // namespace capstan::robot
