#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/field.h"

namespace capstan::robot {

/// Description of one number of an effect.
struct EffectParameter {
  std::string_view name;
  std::string_view unit;               ///< SI unit; "rad or m" when it depends on the type of the joint
  double low = 0.0, high = 0.0;        ///< bounds of the number in a robot file
  std::string_view what;               ///< meaning, shown when the number is missing
  std::optional<double> omitted = {};  ///< value where a robot file omits the number; empty: it is required
};

/// Description of an effect that a robot can have beyond the nominal model. The physics is in
/// chain/chain_law.h (for numbers of the model and for cameras in chain_model.cpp); core/diagnosis/hypotheses
/// has the texts.
struct EffectFacts {
  std::string_view name;
  bool whole = false;  ///< whether it belongs to the whole arm or a camera (joint 0), not to one joint
  bool cable = true;   ///< whether a cable drive can have it
  bool rigid = true;   ///< whether a rigid drive can have it
  std::vector<EffectParameter> parameters;
};

/// All effects, in the order of lists for people.
const std::vector<EffectFacts>& effectFacts();
/// Effect of this name; a null pointer when there is none.
const EffectFacts* effectNamed(std::string_view name);

struct EffectValue {
  static constexpr bool kMapEntry = true;  ///< written to a file as `half_width: 4.5e-4`
  std::string parameter;
  double value = 0.0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.parameter, {"parameter", "", "name of the number"});
    field(self.value, {"value", "SI", "the number"});
  }
};

/// One effect in one robot, as a robot file lists it under `effects`.
struct Effect {
  std::string effect;               ///< EffectFacts::name
  int joint = 0;                    ///< joint from 1; 0: the whole arm or a camera
  std::vector<EffectValue> values;  ///< values of EffectFacts::parameters

  /// Value of this parameter, or EffectParameter::omitted where it is not in `values`. Throws
  /// base::InputError when the effect has no such parameter, or a required one is missing.
  double operator[](std::string_view parameter) const;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.effect, {"effect", "", "name of the effect"});
    field(self.joint, {"joint", "", "from 1; 0 for the whole arm or a camera"});
    field(self.values, {"values", "", "its numbers"});
  }
};

}  // namespace capstan::robot
