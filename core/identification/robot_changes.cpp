#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/identification/parameters.h"
#include "core/robot/fold_effects.h"

namespace capstan::identification {
namespace {

/// A number of a robot file and its key.
using Numbers = std::vector<std::pair<std::string, double>>;

template <class T>
void gather(const T& value, const std::string& key, Numbers& numbers) {
  if constexpr (base::Visitable<T>) {
    T::visit(value, [&](const auto& field, const base::FieldInfo& info) {
      gather(field, key.empty() ? std::string(info.key) : key + "." + std::string(info.key), numbers);
    });
  } else if constexpr (std::is_arithmetic_v<T>) {
    numbers.emplace_back(key, static_cast<double>(value));
  } else if constexpr (base::detail::IsVector<T>::value) {
    for (std::size_t i = 0; i < value.size(); ++i)
      gather(value[i], key + "[" + std::to_string(i) + "]", numbers);
  } else if constexpr (base::detail::FixedMatrix<T>) {
    for (Eigen::Index i = 0; i < value.size(); ++i)
      gather(value(i), key + "[" + std::to_string(i) + "]", numbers);
  }
}

}  // namespace

std::optional<Parameter> RobotChange::parameter() const {
  constexpr std::array<std::pair<const char*, Quantity>, kQuantities> kKeys = {
      {{"drives[{}].link_radius", Quantity::kLinkRadius},
       {"drives[{}].cable_stiffness", Quantity::kStiffness},
       {"drives[{}].cable_damping", Quantity::kDamping},
       {"joints[{}].friction.coulomb", Quantity::kFriction}}};
  for (int joint = 0; joint < 3; ++joint)
    for (const auto& [pattern, quantity] : kKeys)
      if (key == fmt::format(fmt::runtime(pattern), joint)) return Parameter{quantity, joint, nominal};
  return std::nullopt;
}

std::string RobotChange::name() const {
  const auto changed = parameter();
  return changed ? changed->name() : std::string();
}

std::vector<RobotChange> differences(const robot::Description& nominal,
                                     const robot::Description& identified) {
  Numbers before, after;
  gather(robot::foldEffects(nominal), {}, before);
  gather(robot::foldEffects(identified), {}, after);
  if (before.size() != after.size())
    throw base::InputError({{},
                            0,
                            "robot",
                            identified.name,
                            "has another number of joints than " + nominal.name,
                            "Compare two files of the same kind of robot"});
  std::vector<RobotChange> changes;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double from = before[i].second, to = after[i].second;
    if (from == to) continue;
    const double percent =
        from == 0.0 ? std::numeric_limits<double>::quiet_NaN() : 100.0 * (to - from) / std::abs(from);
    changes.push_back({before[i].first, from, to, percent});
  }
  return changes;
}

}  // namespace capstan::identification
