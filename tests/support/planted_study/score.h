#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "tests/support/planted_study/planted_numbers.h"

namespace capstan::study {

/// Result of an answer for one planted effect.
enum class Hit {
  kRight,       ///< right effect and joint named first, not as one of a tie
  kTie,         ///< the first cause is one of a tie that contains the effect
  kLater,       ///< named, or in a tie of another cause, but not first
  kWrongJoint,  ///< the effect named first is right, its joint is not
  kWrong,       ///< another effect named
  kNothing,     ///< "nothing material"
  kUnexplained,
  kError,
};

/// Score of a case with one planted effect.
struct Score {
  Hit hit = Hit::kNothing;
  /// First result: an effect, or none, unexplained or error. For a tie it is the planted effect if the tie
  /// contains it, else the best of the tie.
  std::string named;
  int named_joint = -1;              ///< −1: nothing named
  std::vector<NumberCheck> numbers;  ///< for kRight only
};

/// Answer of a case without the causes that are part of its background texture and not one of its planted
/// effects: these are in the robot, and naming them is no error. "nothing" where no cause remains.
Answer withoutTexture(const CaseOutcome& outcome);

/// Score of withoutTexture() of a case with one effect that is among the hypotheses.
Score scoreOne(const CaseOutcome& outcome);

/// Score of withoutTexture() of a case with two effects, regardless of their order among the causes.
struct PairScore {
  std::array<Hit, 2> hits{};  ///< kRight: among the causes; kTie: in a tie only
  bool both() const { return hits[0] == Hit::kRight && hits[1] == Hit::kRight; }
  bool bothWithTies() const;
  int right() const { return (hits[0] == Hit::kRight) + (hits[1] == Hit::kRight); }
};
PairScore scoreTwo(const CaseOutcome& outcome);

/// First result of an answer, whatever was planted: an effect, "nothing", "unexplained" or "error".
std::string firstNamed(const Answer& answer);
/// Cause whose effect firstNamed() returns; null: no effect is named.
const NamedCause* firstCause(const Answer& answer);

/// True unless withoutTexture() is "nothing"; without a planted effect this is a false alarm.
bool isAlarm(const CaseOutcome& outcome);

}  // namespace capstan::study

template <>
struct capstan::base::NamesOf<capstan::study::Hit> {
  using H = capstan::study::Hit;
  static constexpr std::array value = {std::pair{H::kRight, "right"},
                                       std::pair{H::kTie, "tie with it"},
                                       std::pair{H::kLater, "named later"},
                                       std::pair{H::kWrongJoint, "wrong joint"},
                                       std::pair{H::kWrong, "wrong"},
                                       std::pair{H::kNothing, "nothing"},
                                       std::pair{H::kUnexplained, "unexplained"},
                                       std::pair{H::kError, "error"}};
};
