#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tests/support/planted/effect_sizes.h"

namespace capstan::test {

/// One effect of a case. Size: 0 none, 0.1 just visible (an open-loop simulation of the reference changes,
/// beyond what drift and texture can make of it, by as much as noise and texture are), 1 large (ten times
/// that, or as large as is plausible where that is less).
/// sensor_sign is there or not: its size is that of the load.
struct ChosenEffect {
  Effect effect = Effect::kPulleyRadius;
  int joint = 1;  ///< counts from 1; 0: the whole arm or a camera
  double size = 0.0;
};

/// Everything that a recording is made of. Same case, same bytes.
struct PlantedCase {
  std::uint64_t seed = 1;
  robot::Description robot;  ///< nominal
  bool rigid = false;        ///< motor torque drives the joints, no cables
  std::vector<ChosenEffect> effects;
  bool textured = false;
  bool is_worn = true;
  double duration = 30.0;  ///< [s]
  SensorOptions sensors;
  Joints load{};       ///< amplitude of measured external loads [N·m or N]
  int refinement = 1;  ///< of the integration steps
};

/// What a diagnosis may see.
struct Recording {
  recording::MeasuredTable table;
  robot::Description robot;  ///< nominal
  bool rigid = false;
};

/// What it may not see.
struct Truth {
  struct Item {
    std::string effect;
    int joint = 0;  ///< counts from 1; 0: the whole arm or a camera
    double size = 0.0;
    double visibility = 0.0;  ///< Visibility::of
    Planted planted;          ///< planted.joint and planted.other count from 0
  };
  std::vector<Item> items;
  std::vector<Planted> texture;  ///< background texture in the recording; empty: it has none
  robot::Description robot;      ///< drifted
  bool textured = false;
};

/// What draw() leaves to chance: everything that is not given.
struct DrawOptions {
  robot::Description robot;
  bool rigid = false;
  std::optional<int> effects;    ///< how many, 0–2; unset: 1
  std::optional<Effect> effect;  ///< of the first
  std::optional<int> joint;      ///< of the first, from 1
  std::optional<double> size;    ///< of the first; unset: 0.1–1, evenly on a logarithmic scale
  bool uncovered = false;        ///< the first is one that no diagnosis has a name for
  std::optional<bool> textured;
  std::optional<double> duration;  ///< unset: 20–40 s
  SensorOptions sensors;
};

/// Joints, counted from 1, on which `effect` makes sense on this robot; {0} for one of the whole arm; none
/// when the drive or the sensors do not have it. Joints whose cable is so stiff that its Coulomb friction
/// moves them by less than five times the sensors' noise have no effects of force.
std::vector<int> jointsFor(Effect effect, const DrawOptions& options);

/// A case from a seed. Throws std::invalid_argument when the wanted effect makes no sense on this robot or
/// joint.
PlantedCase draw(std::uint64_t seed, const DrawOptions& options);

Recording record(const PlantedCase& planted_case);
Truth truthOf(const PlantedCase& planted_case);
/// Both, for the price of one.
std::pair<Recording, Truth> recordWithTruth(const PlantedCase& planted_case);

}  // namespace capstan::test
