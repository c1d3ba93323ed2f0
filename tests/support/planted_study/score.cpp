#include "tests/support/planted_study/score.h"

#include <algorithm>

namespace capstan::study {
namespace {

using Item = test::Truth::Item;

bool is(const NamedCause& cause, const Item& item) {
  return cause.effect == item.effect && cause.joint == item.joint;
}

const NamedCause* among(const std::vector<NamedCause>& causes, const Item& item) {
  const auto found =
      std::find_if(causes.begin(), causes.end(), [&](const NamedCause& cause) { return is(cause, item); });
  return found == causes.end() ? nullptr : &*found;
}

bool tied(const Answer& answer, const Item& item) {
  return std::any_of(answer.ties.begin(), answer.ties.end(),
                     [&](const auto& tie) { return among(tie, item) != nullptr; });
}

/// Of an answer that does not name the item.
Hit missOf(const Answer& answer, const Item& item) {
  if (answer.verdict == "error") return Hit::kError;
  if (answer.verdict == "nothing") return Hit::kNothing;
  const NamedCause* first = firstCause(answer);
  if (first == nullptr) return Hit::kUnexplained;
  return first->effect == item.effect ? Hit::kWrongJoint : Hit::kWrong;
}

/// A tie of the first cause contains the item.
bool tiedFirst(const Answer& answer, const Item& item) {
  return answer.verdict == "tie" && !answer.ties.empty() && among(answer.ties.front(), item);
}

Hit hitOf(const Answer& answer, const Item& item) {
  if (tiedFirst(answer, item)) return Hit::kTie;
  const NamedCause* first = firstCause(answer);
  if (first != nullptr && is(*first, item)) return Hit::kRight;
  if (first != nullptr && (among(answer.causes, item) || tied(answer, item))) return Hit::kLater;
  return missOf(answer, item);
}

}  // namespace

const NamedCause* firstCause(const Answer& answer) {
  if (answer.verdict != "found" && answer.verdict != "several" && answer.verdict != "tie") return nullptr;
  if (answer.verdict == "tie" && !answer.ties.empty() && !answer.ties.front().empty())
    return &answer.ties.front().front();
  return answer.causes.empty() ? nullptr : &answer.causes.front();
}

std::string firstNamed(const Answer& answer) {
  if (const NamedCause* first = firstCause(answer)) return first->effect;
  return answer.verdict == "nothing" || answer.verdict == "error" ? answer.verdict : "unexplained";
}

Answer withoutTexture(const CaseOutcome& outcome) {
  Answer answer = outcome.answer;
  const HiddenTruth& truth = outcome.truth;
  std::erase_if(answer.causes, [&](const NamedCause& cause) {
    const bool planted = std::any_of(truth.items.begin(), truth.items.end(),
                                     [&](const Item& item) { return is(cause, item); });
    return !planted &&
           std::any_of(truth.texture.begin(), truth.texture.end(), [&](const test::Planted& texture) {
             return test::factsOf(texture.effect).name == cause.effect && texture.joint + 1 == cause.joint;
           });
  });
  if (answer.causes.empty() && (answer.verdict == "found" || answer.verdict == "several"))
    answer.verdict = "nothing";
  return answer;
}

bool isAlarm(const CaseOutcome& outcome) { return withoutTexture(outcome).verdict != "nothing"; }

Score scoreOne(const CaseOutcome& outcome) {
  const Item& item = outcome.truth.items.at(0);
  const Answer answer = withoutTexture(outcome);
  Score score;
  score.hit = hitOf(answer, item);
  score.named = score.hit == Hit::kTie ? item.effect : firstNamed(answer);
  if (const NamedCause* first = firstCause(answer)) score.named_joint = first->joint;
  if (score.hit == Hit::kTie) score.named_joint = item.joint;
  if (score.hit == Hit::kRight) score.numbers = checkNumbers(outcome.truth, 0, *firstCause(answer));
  return score;
}

bool PairScore::bothWithTies() const {
  return std::all_of(hits.begin(), hits.end(),
                     [](Hit hit) { return hit == Hit::kRight || hit == Hit::kTie; });
}

PairScore scoreTwo(const CaseOutcome& outcome) {
  PairScore score;
  const Answer answer = withoutTexture(outcome);
  for (std::size_t k = 0; k < 2; ++k) {
    const Item& item = outcome.truth.items.at(k);
    const bool names = firstCause(answer) != nullptr;
    score.hits[k] = names && tied(answer, item)                      ? Hit::kTie
                    : names && among(answer.causes, item) != nullptr ? Hit::kRight
                                                                     : missOf(answer, item);
  }
  return score;
}

}  // namespace capstan::study
