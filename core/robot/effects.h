#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/field.h"

namespace capstan::robot {

/// One number of an effect.
struct EffectParameter {
  std::string_view name;
  std::string_view unit;         ///< SI; "rad or m" where it goes by the joint
  double low = 0.0, high = 0.0;  ///< what a robot file may say
  std::string_view what;         ///< in words
};

/// What can be in a robot beyond the nominal model. Its physics is in chain/chain_law.h (or, for numbers of
/// the model and for cameras, in effects.cpp); the words are the hypotheses' (core/diagnosis/hypotheses).
struct EffectFacts {
  std::string_view name;
  bool whole = false;  ///< of the whole arm or of a camera: joint 0
  bool cable = true;   ///< may be in a cable drive
  bool rigid = true;   ///< may be in a rigid drive
  std::vector<EffectParameter> parameters;
};

/// All of them, in the order in which they are listed to people.
const std::vector<EffectFacts>& effectFacts();
/// Null: no effect of this name.
const EffectFacts* effectNamed(std::string_view name);

struct EffectValue {
  static constexpr bool kMapEntry = true;  ///< `half_width: 4.5e-4` in a file
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
  int joint = 0;                    ///< from 1; 0: the whole arm or a camera
  std::vector<EffectValue> values;  ///< all of EffectFacts::parameters

  /// base::InputError: it has none of this name.
  double operator[](std::string_view parameter) const;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.effect, {"effect", "", "name of the effect"});
    field(self.joint, {"joint", "", "from 1; 0 for the whole arm or a camera"});
    field(self.values, {"values", "", "its numbers"});
  }
};

}  // namespace capstan::robot
