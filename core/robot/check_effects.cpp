#include "core/robot/check_effects.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/yaml.h"
#include "core/robot/chain/chain_model.h"

namespace capstan::robot {
namespace {

/// One effect of a file and its location.
struct Listed {
  YAML::Node node;
  base::YamlPlace place;
  const Effect& effect;

  base::YamlPlace at(const std::string& key) const { return {place.file, place.key + "." + key}; }
};

std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const EffectFacts& facts : effectFacts()) names.emplace_back(facts.name);
  return names;
}

const EffectFacts& checkName(const Listed& listed, DriveType drive) {
  const EffectFacts* facts = effectNamed(listed.effect.effect);
  const YAML::Node node = listed.node["effect"];
  if (facts == nullptr)
    base::refuseYaml(node, listed.at("effect"), "is not a known effect",
                     base::remedyForUnknown(listed.effect.effect, allNames()));
  if (!(drive == DriveType::kCable ? facts->cable : facts->rigid))
    base::refuseYaml(node, listed.at("effect"),
                     fmt::format("cannot be in a robot whose drive is {}", base::nameOf(drive)),
                     fmt::format("Remove it, or write drive: {}", drive == DriveType::kCable
                                                                      ? base::nameOf(DriveType::kRigid)
                                                                      : base::nameOf(DriveType::kCable)));
  return *facts;
}

void checkJoint(const Listed& listed, const EffectFacts& facts, int joints) {
  const int joint = listed.effect.joint;
  if (facts.whole ? joint == 0 : joint >= 1 && joint <= joints) return;
  if (facts.whole)
    base::refuseYaml(listed.node["joint"], listed.at("joint"),
                     fmt::format("is not 0, but {} belongs to the whole arm or its cameras", facts.name),
                     "Write 0");
  base::refuseYaml(listed.node["joint"], listed.at("joint"), "is not a joint of the robot",
                   fmt::format("Write 1 to {}", joints));
}

void checkValues(const Listed& listed, const EffectFacts& facts) {
  const YAML::Node values = listed.node["values"];
  std::vector<std::string> known;
  for (const EffectParameter& parameter : facts.parameters) known.emplace_back(parameter.name);
  base::refuseUnknownKeys(values, listed.at("values"), known);
  for (const EffectParameter& parameter : facts.parameters) {
    const std::string name(parameter.name);
    const base::YamlPlace place = listed.at("values." + name);
    if (!values[name].IsDefined() && parameter.omitted) continue;
    if (!values[name].IsDefined())
      base::refuseYaml(values, place, "is missing", fmt::format("Add it: {}", parameter.what));
    base::yamlNumber(values[name], place,
                     {parameter.name, parameter.unit, parameter.what, {parameter.low, parameter.high}});
  }
}

void checkOther(const Listed& listed, int joints) {
  const double other = listed.effect["other"];
  if (other == std::floor(other) && other <= joints && other != listed.effect.joint) return;
  base::refuseYaml(listed.node["values"]["other"], listed.at("values.other"),
                   "is not another joint of the robot",
                   fmt::format("Write 1 to {}, but not {}", joints, listed.effect.joint));
}

/// Refuses a second effect of one law at a joint: its other numbers, such as a time constant, exist only
/// once.
void checkOnce(const Listed& listed, const std::vector<Effect>& effects, std::size_t i) {
  const Effect& effect = listed.effect;
  const auto before = effects.begin() + static_cast<std::ptrdiff_t>(i);
  if (lawOf(effect.effect) == 0 || std::none_of(effects.begin(), before, [&](const Effect& other) {
        return other.effect == effect.effect && other.joint == effect.joint;
      }))
    return;
  base::refuseYaml(listed.node["effect"], listed.at("effect"),
                   fmt::format("is already in joint {}", effect.joint), "List it once");
}

void checkTogether(const YAML::Node& node, const std::string& file, const Description& description) {
  const ChainModel model(description);
  const int n = model.shape.joints;
  JointVector middle(n);
  for (int i = 0; i < n; ++i) middle[i] = model.shape.middle[i];
  Eigen::FullPivLU<JointMatrix> decomposition(couplingMatrix(model));
  decomposition.setThreshold(1e-9);
  if (!decomposition.isInvertible())
    base::refuseYaml(node, {file, "effects"},
                     "make a coupling that cannot be inverted: motors would not determine the joints",
                     "Check the numbers of cable_coupling");
  if (Eigen::LLT<JointMatrix>(massMatrix(model, middle)).info() != Eigen::Success)
    base::refuseYaml(node, {file, "effects"}, "remove more inertia than the robot has",
                     "Check the numbers of payload and inertia");
}

}  // namespace

void checkEffects(const YAML::Node& root, const std::string& file, const Description& description) {
  const std::vector<Effect>& effects = description.effects;
  if (effects.empty()) return;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Listed listed{root["effects"][i], {file, fmt::format("effects[{}]", i)}, effects[i]};
    const EffectFacts& facts = checkName(listed, description.drive);
    checkJoint(listed, facts, description.size());
    checkValues(listed, facts);
    if (facts.name == "cable_coupling") checkOther(listed, description.size());
    checkOnce(listed, effects, i);
  }
  checkTogether(root["effects"], file, description);
}

}  // namespace capstan::robot
