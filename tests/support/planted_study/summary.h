#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/stats/interval.h"
#include "tests/support/planted_study/detection_limit.h"
#include "tests/support/planted_study/score.h"

namespace capstan::study {

/// Number of hits in a number of trials.
struct Proportion {
  int hits = 0, trials = 0;
  void add(bool hit) { hits += hit, ++trials; }
  double share() const;              ///< NaN without trials
  stats::Interval interval() const;  ///< 95 %, Clopper and Pearson; [0, 1] without trials
};

/// One result of the study, and its goal.
struct Aim {
  enum class Goal { kNone, kAtLeast, kAtMost };
  std::string what;
  Proportion result;
  Goal goal = Goal::kNone;
  double aim = 0.0;
  bool met() const;
};

/// Group of cases with one effect that is among the hypotheses: all of one effect, robot or range of sizes.
struct Group {
  std::string name;
  std::array<int, base::NamesOf<Hit>::value.size()> hits{};  ///< number of cases per Hit
  Proportion numbers;                                        ///< estimated numbers inside their 95 % interval
  DetectionLimit limit;                                      ///< detection limit; found means kRight or kTie
  double ideal = 0.0;  ///< median of HiddenTruth::ideal_limit; NaN: none
  int cases() const;
  int count(Hit hit) const { return hits[static_cast<std::size_t>(hit)]; }
};

/// Confusion matrix of planted effects × first results, without empty rows and columns. A right effect on a
/// wrong joint counts as that effect.
struct Confusion {
  std::vector<std::string> planted, named;
  std::map<std::pair<std::string, std::string>, int> counts;
};

/// Case with a wrong or missing result.
struct Miss {
  CaseOutcome outcome;
  std::string planted, said;  ///< planted effect and result, for people
};

/// Summary of a study.
struct Summary {
  std::vector<Aim> aims;
  std::vector<Group> effects, groups;
  Confusion confusion;
  std::vector<std::pair<std::string, NumberCheck>> outside;  ///< case, and number outside of its 95 %
  std::vector<Miss> misses;
  std::vector<double> seconds;  ///< durations of the diagnoses, in rising order
};

Summary summaryOf(const std::vector<CaseOutcome>& outcomes);

}  // namespace capstan::study
