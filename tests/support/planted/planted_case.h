#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tests/support/planted/effect_sizes.h"
#include "tests/support/planted/excitation.h"

namespace capstan::test {

/// One effect of a case. Size 0 is no effect; size 0.1 is just visible (Visibility 1: beyond what drift and
/// texture can imitate, the readings change by as much as noise and texture); size 1 is large (ten times
/// that, or the largest plausible size if it is less). sensor_sign has no size of its own: its size is that
/// of the load.
struct ChosenEffect {
  Effect effect = Effect::kPulleyRadius;
  int joint = 1;  ///< counts from 1; 0: the whole arm or a camera
  double size = 0.0;
};

/// Complete specification of a recording. The same case gives the same bytes.
struct PlantedCase {
  std::uint64_t seed = 1;
  robot::Description robot;  ///< nominal
  bool rigid = false;        ///< motor torque drives the joints, no cables
  std::vector<ChosenEffect> effects;
  bool textured = false;
  bool is_worn = true;
  Ageing ageing;
  MotionStyle style = MotionStyle::kMoves;
  double duration = 30.0;  ///< [s]
  SensorOptions sensors;
  Joints load{};       ///< amplitude of measured external loads [N·m or N]
  int refinement = 1;  ///< PlantParameters::refinement
};

/// Data that a diagnosis may use.
struct Recording {
  recording::MeasuredTable table;
  robot::Description robot;  ///< nominal
};

/// Data that a diagnosis may not use: what was planted.
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
  robot::Description robot;      ///< worn robot
  bool textured = false;
};

/// Options of draw(), which draws at random everything that is not given.
struct DrawOptions {
  robot::Description robot;
  bool rigid = false;
  std::optional<int> effects;    ///< number of effects, 0–2; unset: 1
  std::optional<Effect> effect;  ///< the first effect
  std::optional<int> joint;      ///< joint of the first effect, from 1
  std::optional<double> size;    ///< size of the first effect; unset: 0.1–1, evenly on a logarithmic scale
  bool uncovered = false;        ///< true: the first effect is not among the hypotheses of a diagnosis
  std::optional<bool> textured;
  std::optional<double> duration;  ///< unset: 20–40 s
  SensorOptions sensors;
  Ageing ageing;
  MotionStyle style = MotionStyle::kMoves;
};

/// Joints, counted from 1, in which `effect` can be planted; {0} for an effect of the whole arm; empty if the
/// drive or the sensors cannot have it. Effects of force are excluded in joints whose cable is so stiff that
/// Coulomb friction moves them by less than five times the sensors' noise.
std::vector<int> jointsFor(Effect effect, const DrawOptions& options);

/// Random case of a seed. Throws std::invalid_argument if the requested effect cannot be planted in this
/// robot or joint.
PlantedCase draw(std::uint64_t seed, const DrawOptions& options);

/// Recording of a case.
Recording record(const PlantedCase& planted_case);
/// Truth of a case.
Truth truthOf(const PlantedCase& planted_case);
/// Another recording of the robot of a case, with noise and loads of `seed`: of the desired motion `path`, or
/// of the random motion of that seed if `path` is empty.
Recording recordAgain(const PlantedCase& planted_case, const JointPath& path, double duration,
                      std::uint64_t seed);
/// record() and truthOf() in one computation.
std::pair<Recording, Truth> recordWithTruth(const PlantedCase& planted_case);

}  // namespace capstan::test
