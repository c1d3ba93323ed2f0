#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::study {

/// What is hidden in a recording.
enum class Kind { kOne, kNone, kTwo, kUncovered };

/// The RAVEN-II with all its sensors; the rigid arm and axis of tests/support/planted/data, whose motor
/// torques drive them.
enum class Robot { kRaven, kArm, kAxis };

/// One recording of a study, told by its name.
struct StudyCase {
  Kind kind = Kind::kOne;
  Robot robot = Robot::kRaven;
  std::string effect;      ///< of kOne and kUncovered; else empty: drawn
  std::uint64_t seed = 1;  ///< everything else is drawn from it

  /// "one backlash raven 1008".
  std::string name() const;
};

struct StudyOptions {
  int seeds = 8;  ///< of each effect that has a name
  int none = 80, two = 40, uncovered = 30;
  std::uint64_t first_seed = 1;
  std::vector<std::string> only;   ///< effects, or none, two, uncovered; empty: all
  std::vector<Robot> robots = {};  ///< where everything happens; empty: see casesOf
};

/// The cases of a study, in an order in which every beginning is a fair sample: first every effect once, and
/// so on. The RAVEN-II, and a rigid drive for each fourth case of an effect that both have and for all of
/// effects that only rigid drives have; of the uncovered external_vibration and nonlinear_spring twice as
/// often as joint_detent and encoder_drift. Combinations without sense are excluded. base::InputError: an
/// unknown name in `only`, or nothing left.
std::vector<StudyCase> casesOf(const StudyOptions& options);

/// Everything drawn: joint, size (of the first effect, where it is not given: 0.1–1, evenly on a logarithmic
/// scale), length (20–40 s), texture (half of all), loads.
test::PlantedCase planned(const StudyCase& one, std::optional<double> size = std::nullopt);

/// The nominal robot of cases on it.
robot::Description robotOf(Robot which);

}  // namespace capstan::study

template <>
struct capstan::base::NamesOf<capstan::study::Kind> {
  using K = capstan::study::Kind;
  static constexpr std::array value = {std::pair{K::kOne, "one"}, std::pair{K::kNone, "none"},
                                       std::pair{K::kTwo, "two"}, std::pair{K::kUncovered, "uncovered"}};
};

template <>
struct capstan::base::NamesOf<capstan::study::Robot> {
  using R = capstan::study::Robot;
  static constexpr std::array value = {std::pair{R::kRaven, "raven"}, std::pair{R::kArm, "arm"},
                                       std::pair{R::kAxis, "axis"}};
};
