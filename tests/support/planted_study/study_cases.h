#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::study {

/// Kind of case: one planted effect, none, two, or one that is not among the hypotheses.
enum class Kind { kOne, kNone, kTwo, kUncovered };

/// Robot of a case: the RAVEN-II; the rigid-drive arm or axis of tests/support/planted/data; or a random
/// robot of one to seven joints with cables (kCables) or with rigid drives (kJoints).
enum class Robot { kRaven, kArm, kAxis, kCables, kJoints };

/// Populations of cases. kUsual: three robots, one kind of motion, the same sensors, files off by up to 1.4.
/// Its seeds were used to develop the diagnosis. kVaried: also random robots, four kinds of motion, other
/// noise, rates and sets of sensors, files off by up to 2, and more or less background texture; robots
/// are drawn until the effect is visible on one (recordCase()).
enum class Population { kUsual, kVaried };

/// One case of a study, identified by its name.
struct StudyCase {
  Kind kind = Kind::kOne;
  Robot robot = Robot::kRaven;
  std::string effect;      ///< effect of kOne and kUncovered; empty for other kinds, which draw it
  std::uint64_t seed = 1;  ///< seed of all other properties
  Population population = Population::kUsual;

  /// Name of the case, for example "one backlash raven 1008", with " varied" for
  /// that population.
  std::string name() const;
};

/// Case of StudyCase::name(). Throws std::invalid_argument for another text.
StudyCase caseNamed(const std::string& name);

struct StudyOptions {
  int seeds = 8;                            ///< number of cases per effect among the hypotheses
  int none = 80, two = 40, uncovered = 30;  ///< number of cases of these kinds
  std::uint64_t first_seed = 1;
  Population population = Population::kUsual;
  std::vector<std::string> only;   ///< effects, or none, two, uncovered; empty: all
  std::vector<Robot> robots = {};  ///< robots of all cases; empty: as casesOf() chooses
};

/// Cases of a study. They are ordered so that the first cases are always a representative sample: first every
/// effect once, then every effect a second time, and so on. The robot is the RAVEN-II. Every fourth case of
/// an effect that both drives can have, and every case of an effect that only rigid drives can have, is on a
/// rigid drive. Of the uncovered effects, external_vibration and nonlinear_spring are twice as frequent as
/// joint_detent and encoder_drift. In the varied population, two of three robots of each kind of drive are
/// random ones. Impossible combinations are excluded. Throws base::InputError for an
/// unknown name in `only`, and if no case is left.
std::vector<StudyCase> casesOf(const StudyOptions& options);

/// Random specification of a case: joint, size of the first effect (if not given: 0.1–1, evenly on a
/// logarithmic scale), duration (20–40 s), texture (in half of the cases), and loads.
test::PlantedCase planned(const StudyCase& one, std::optional<double> size = std::nullopt);

/// Nominal description of a robot that a file describes.
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
                                       std::pair{R::kAxis, "axis"}, std::pair{R::kCables, "cables"},
                                       std::pair{R::kJoints, "joints"}};
};

template <>
struct capstan::base::NamesOf<capstan::study::Population> {
  using P = capstan::study::Population;
  static constexpr std::array value = {std::pair{P::kUsual, "usual"}, std::pair{P::kVaried, "varied"}};
};
