#include "core/simulation/tool_truth.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::simulation {

ToolTruth readToolTruth(const std::filesystem::path& path) { return base::readYamlFile<ToolTruth>(path); }

robot::Description trueRobot(const robot::Description& nominal, const ToolTruth& truth) {
  if (nominal.size() != robot::kToolJoints)
    throw base::InputError({nominal.name, 0, "joints", fmt::format("{}", nominal.size()),
                            "is not seven joints", "Use a robot file like raven2_left_tool.yaml"});
  robot::Description robot = nominal;
  for (std::size_t i = 0; i < robot::kToolJoints; ++i) {
    const ToolJointTruth& joint = truth.joints[i];
    robot::DhRow& row = robot.joints[i].dh;
    row.alpha += joint.geometry.alpha;
    row.a += joint.geometry.a;
    row.d += joint.geometry.d;
    row.theta += joint.geometry.theta;
    robot.joints[i].homing += joint.homing_error;
    robot.drives[i].link_radius *= 1.0 + joint.radius_share;
    for (std::size_t k = 0; k < robot::kToolJoints; ++k)
      robot.coupling[i][k] +=
          truth.coupling_error(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  }
  return robot;
}

}  // namespace capstan::simulation
