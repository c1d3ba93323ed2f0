#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "tests/support/planted_study/planted_numbers.h"

namespace capstan::study {

/// How an answer stands to one effect that was planted.
enum class Hit {
  kRight,       ///< right effect and joint named first, not as one of a tie
  kTie,         ///< one of a tie that contains it
  kLater,       ///< named, but not first
  kWrongJoint,  ///< the effect named first is right, its joint is not
  kWrong,       ///< another effect named
  kNothing,     ///< "nothing material"
  kUnexplained,
  kError,
};

struct Score {
  Hit hit = Hit::kNothing;
  /// What is named first: an effect, or none, unexplained, error; of a tie the planted effect where it is in
  /// it, else the tie's best.
  std::string named;
  int named_joint = -1;              ///< −1: nothing named
  std::vector<NumberCheck> numbers;  ///< where the effect was named rightly and alone
};

/// Of a case with one effect that has a name.
Score scoreOne(const CaseOutcome& outcome);

/// Of a case with two effects: how each of them comes out, its place among the causes aside.
struct PairScore {
  std::array<Hit, 2> hits{};  ///< kRight: among the causes; kTie: in a tie only
  bool both() const { return hits[0] == Hit::kRight && hits[1] == Hit::kRight; }
  bool bothWithTies() const;
  int right() const { return (hits[0] == Hit::kRight) + (hits[1] == Hit::kRight); }
};
PairScore scoreTwo(const CaseOutcome& outcome);

/// What a case says first, whatever was planted: an effect, "nothing", "unexplained" or "error".
std::string firstNamed(const Answer& answer);
/// The cause that firstNamed tells of; null: it is none.
const NamedCause* firstCause(const Answer& answer);

/// Anything but "nothing" is a false alarm where nothing was planted.
bool isAlarm(const Answer& answer);

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
