#include "tests/support/planted_study/run_case.h"

#include <chrono>
#include <limits>

#include "core/diagnosis/evidence/read_evidence.h"
#include "tests/support/planted_study/ideal_limit.h"

namespace capstan::study {
namespace {

constexpr std::uint64_t kMostRobots = 20;  // that are drawn for a case until the plant can integrate one

Answer diagnosed(const test::Recording& recording, const Diagnoser& diagnoser) {
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  try {
    const diagnosis::Report report =
        diagnoser({diagnosis::evidenceOf(recording.table, recording.robot)}, recording.robot);
    return answerOf(report, seconds());
  } catch (const std::exception& error) {
    Answer answer;
    answer.verdict = "error";
    answer.summary = error.what();
    answer.seconds = seconds();
    return answer;
  }
}

}  // namespace

CaseOutcome runCase(const StudyCase& one, const Diagnoser& diagnoser, const RunOptions& options) {
  constexpr std::uint64_t kOther = 1'000'000'000'000;  // seeds beyond those of all cases
  for (StudyCase drawn = one;; drawn.seed += kOther) {
    try {
      CaseOutcome outcome = runCase(drawn, planned(drawn), diagnoser, options);
      outcome.of = one;
      return outcome;
    } catch (const test::TooStiff&) {
      if (drawn.seed > one.seed + kMostRobots * kOther) throw;
    }
  }
}

CaseOutcome runCase(const StudyCase& one, const test::PlantedCase& drawn, const Diagnoser& diagnoser,
                    const RunOptions& options) {
  const auto [recording, truth] = test::recordWithTruth(drawn);
  CaseOutcome outcome;
  outcome.of = one;
  outcome.truth = {truth.items, truth.texture, drawn.duration, std::numeric_limits<double>::quiet_NaN()};
  if (options.ideal_limit && one.kind == Kind::kOne) {
    const auto& item = truth.items.front();
    outcome.truth.ideal_limit = IdealObserver(drawn, truth).limit(item.planted, item.size).size;
  }
  outcome.answer = diagnosed(recording, diagnoser);
  return outcome;
}

}  // namespace capstan::study
