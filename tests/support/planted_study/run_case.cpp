#include "tests/support/planted_study/run_case.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include "core/diagnosis/evidence/read_evidence.h"
#include "tests/support/planted_study/ideal_limit.h"

namespace capstan::study {
namespace {

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

bool isVisible(const test::Truth& truth) {
  return std::ranges::all_of(truth.items, [](const auto& item) { return item.visibility >= kJustVisible; });
}

CaseOutcome outcomeOf(const StudyCase& one, const RecordedCase& recorded, const Diagnoser& diagnoser,
                      const RunOptions& options) {
  const auto& [drawn, recording, truth] = recorded;
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

}  // namespace

RecordedCase recordCase(const StudyCase& one) {
  constexpr std::uint64_t kOther = 1'000'000'000'000;  // seeds beyond those of all cases
  std::optional<RecordedCase> last;
  StudyCase drawn = one;
  for (std::uint64_t robot = 0; robot < kMostRobots; ++robot, drawn.seed += kOther) {
    try {
      const test::PlantedCase planted = planned(drawn);
      auto [recording, truth] = test::recordWithTruth(planted);
      last = {planted, std::move(recording), std::move(truth)};
      if (one.population != Population::kVaried || isVisible(last->truth)) break;
    } catch (const test::TooStiff&) {
      if (robot + 1 == kMostRobots && !last) throw;
    }
  }
  return *std::move(last);
}

CaseOutcome runCase(const StudyCase& one, const Diagnoser& diagnoser, const RunOptions& options) {
  return outcomeOf(one, recordCase(one), diagnoser, options);
}

CaseOutcome runCase(const StudyCase& one, const test::PlantedCase& drawn, const Diagnoser& diagnoser,
                    const RunOptions& options) {
  auto [recording, truth] = test::recordWithTruth(drawn);
  return outcomeOf(one, {drawn, std::move(recording), std::move(truth)}, diagnoser, options);
}

}  // namespace capstan::study
