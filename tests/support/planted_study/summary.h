#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/stats/interval.h"
#include "tests/support/planted_study/detection_limit.h"
#include "tests/support/planted_study/score.h"

namespace capstan::study {

struct Proportion {
  int hits = 0, trials = 0;
  void add(bool hit) { hits += hit, ++trials; }
  double share() const;              ///< NaN without trials
  stats::Interval interval() const;  ///< 95 %, Clopper and Pearson; [0, 1] without trials
};

/// A question that the study asks, and what is aimed at.
struct Aim {
  enum class Goal { kNone, kAtLeast, kAtMost };
  std::string what;
  Proportion result;
  Goal goal = Goal::kNone;
  double aim = 0.0;
  bool met() const;
};

/// Cases with one effect that has a name, of one kind: an effect, a robot, a range of sizes.
struct Group {
  std::string name;
  std::array<int, base::NamesOf<Hit>::value.size()> hits{};  ///< by Hit
  Proportion numbers;                                        ///< inside their 95 %
  DetectionLimit limit;                                      ///< found: right, or a tie with it
  double ideal = 0.0;  ///< median of HiddenTruth::ideal_limit; NaN: none
  int cases() const;
  int count(Hit hit) const { return hits[static_cast<std::size_t>(hit)]; }
};

/// Planted × first named, what never occurs excluded; a case that was named on the wrong joint counts under
/// its name.
struct Confusion {
  std::vector<std::string> planted, named;
  std::map<std::pair<std::string, std::string>, int> counts;
};

/// A case that did not come out as it should.
struct Miss {
  CaseOutcome outcome;
  std::string planted, said;  ///< for people
};

struct Summary {
  std::vector<Aim> aims;
  std::vector<Group> effects, groups;
  Confusion confusion;
  std::vector<std::pair<std::string, NumberCheck>> outside;  ///< case, number outside its 95 %
  std::vector<Miss> misses;
  std::vector<double> seconds;  ///< that each diagnosis took, rising
};

Summary summaryOf(const std::vector<CaseOutcome>& outcomes);

}  // namespace capstan::study
