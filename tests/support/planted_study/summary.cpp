#include "tests/support/planted_study/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/stats/proportion.h"
#include "core/stats/quantile.h"
#include "tests/support/planted_study/run_case.h"

namespace capstan::study {
namespace {

constexpr std::array kUncoveredNames = {"external_vibration", "nonlinear_spring", "joint_detent",
                                        "encoder_drift"};

std::vector<const CaseOutcome*> ofKind(const std::vector<CaseOutcome>& outcomes, Kind kind) {
  std::vector<const CaseOutcome*> found;
  for (const CaseOutcome& outcome : outcomes)
    if (outcome.of.kind == kind) found.push_back(&outcome);
  return found;
}

template <class Holds>
Proportion proportion(const std::vector<const CaseOutcome*>& outcomes, Holds&& holds) {
  Proportion result;
  for (const CaseOutcome* outcome : outcomes) result.add(holds(*outcome));
  return result;
}

template <class Belongs>
Group groupOf(std::string name, const std::vector<const CaseOutcome*>& outcomes, Belongs&& belongs) {
  Group group;
  group.name = std::move(name);
  std::vector<Trial> trials;
  std::vector<double> ideal;
  for (const CaseOutcome* outcome : outcomes) {
    if (!belongs(*outcome)) continue;
    const Score score = scoreOne(*outcome);
    const auto& item = outcome->truth.items.front();
    ++group.hits[static_cast<std::size_t>(score.hit)];
    for (const NumberCheck& number : score.numbers) group.numbers.add(number.inside());
    trials.push_back({item.size, score.hit == Hit::kRight || score.hit == Hit::kTie});
    ideal.push_back(outcome->truth.ideal_limit);
  }
  group.limit = detectionLimit(std::move(trials));
  group.ideal = stats::median(ideal);
  return group;
}

std::vector<Group> groupsByEffect(const std::vector<const CaseOutcome*>& ones) {
  std::vector<Group> groups;
  for (const test::EffectFacts& facts : test::allEffects()) {
    Group group = groupOf(std::string(facts.name), ones,
                          [&](const CaseOutcome& outcome) { return outcome.of.effect == facts.name; });
    if (group.cases() > 0) groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<Group> otherGroups(const std::vector<const CaseOutcome*>& ones) {
  std::vector<Group> groups;
  for (const auto& [robot, name] : base::NamesOf<Robot>::value)
    groups.push_back(groupOf(std::string("robot: ") + name, ones,
                             [&](const CaseOutcome& outcome) { return outcome.of.robot == robot; }));
  for (const bool textured : {false, true})
    groups.push_back(
        groupOf(textured ? "background texture" : "no texture", ones,
                [&](const CaseOutcome& outcome) { return outcome.truth.texture.empty() != textured; }));
  constexpr std::array bounds = {0.0, 0.215, 0.464, 1e9};
  for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
    groups.push_back(groupOf(std::array{"size below 0.22", "size 0.22 to 0.46", "size above 0.46"}[k], ones,
                             [&](const CaseOutcome& outcome) {
                               const double size = outcome.truth.items.front().size;
                               return size >= bounds[k] && size < bounds[k + 1];
                             }));
  for (const bool visible : {false, true})
    groups.push_back(groupOf(visible ? "just visible and more" : "even at its largest less than just visible",
                             ones, [&](const CaseOutcome& outcome) {
                               return (outcome.truth.items.front().visibility >= kJustVisible) == visible;
                             }));
  std::erase_if(groups, [](const Group& group) { return group.cases() == 0; });
  return groups;
}

std::string wordsOf(const NamedCause& cause) { return fmt::format("{} {}", cause.effect, cause.joint); }

/// "backlash 2 (0.35)"
std::string plantedWords(const CaseOutcome& outcome) {
  std::string words;
  for (const auto& item : outcome.truth.items)
    words += fmt::format("{}{} {} ({:.2f})", words.empty() ? "" : " + ", item.effect, item.joint, item.size);
  return words.empty() ? "nothing" : words;
}

std::string saidWords(const Answer& answer) {
  std::string words = answer.verdict;
  for (const NamedCause& cause : answer.causes) words += "; " + wordsOf(cause);
  for (const auto& tie : answer.ties) {
    words += "; tie:";
    for (const NamedCause& cause : tie) words += " " + wordsOf(cause);
  }
  return answer.verdict == "error" ? words + ": " + answer.summary : words;
}

bool isRight(const CaseOutcome& outcome) {
  switch (outcome.of.kind) {
    case Kind::kOne: {
      const Hit hit = scoreOne(outcome).hit;
      return hit == Hit::kRight || hit == Hit::kTie;
    }
    case Kind::kNone:
      return !isAlarm(outcome);
    case Kind::kTwo:
      return scoreTwo(outcome).bothWithTies();
    case Kind::kUncovered:
      break;
  }
  return outcome.answer.verdict == "unexplained";
}

Confusion confusionOf(const std::vector<CaseOutcome>& outcomes) {
  Confusion confusion;
  for (const test::EffectFacts& facts : test::allEffects()) {
    confusion.planted.emplace_back(facts.name);
    if (facts.covered) confusion.named.emplace_back(facts.name);
  }
  confusion.planted.emplace_back("nothing");
  for (const char* word : {"nothing", "unexplained", "error"}) confusion.named.emplace_back(word);
  for (const CaseOutcome& outcome : outcomes) {
    if (outcome.of.kind == Kind::kTwo) continue;
    const std::string named =
        outcome.of.kind == Kind::kOne ? scoreOne(outcome).named : firstNamed(outcome.answer);
    ++confusion.counts[{outcome.of.kind == Kind::kNone ? "nothing" : outcome.of.effect, named}];
  }
  const auto drop = [&](std::vector<std::string>& names, auto&& nameOf) {
    std::erase_if(names, [&](const std::string& name) {
      return std::none_of(confusion.counts.begin(), confusion.counts.end(),
                          [&](const auto& entry) { return nameOf(entry.first) == name; });
    });
  };
  drop(confusion.planted, [](const auto& pair) { return pair.first; });
  drop(confusion.named, [](const auto& pair) { return pair.second; });
  return confusion;
}

std::vector<Aim> aimsOf(const std::vector<CaseOutcome>& outcomes) {
  using Goal = Aim::Goal;
  const auto ones = ofKind(outcomes, Kind::kOne), none = ofKind(outcomes, Kind::kNone);
  const auto two = ofKind(outcomes, Kind::kTwo), uncovered = ofKind(outcomes, Kind::kUncovered);
  const auto hit = [&](Hit wanted) {
    return proportion(ones, [&](const CaseOutcome& outcome) { return scoreOne(outcome).hit == wanted; });
  };
  Proportion numbers, whole;
  for (const CaseOutcome* outcome : ones) {
    const auto checks = scoreOne(*outcome).numbers;
    for (const NumberCheck& check : checks) numbers.add(check.inside());
    if (!checks.empty())
      whole.add(
          std::all_of(checks.begin(), checks.end(), [](const NumberCheck& check) { return check.inside(); }));
  }
  std::vector<Aim> aims = {
      {"right name and joint first", hit(Hit::kRight), Goal::kAtLeast, 0.95},
      {"an honest tie that contains it", hit(Hit::kTie)},
      {"named, but not first", hit(Hit::kLater)},
      {"numbers of these inside their 95 %", numbers, Goal::kAtLeast, 0.90},
      {"all numbers of a cause inside", whole},
      {"false alarms", proportion(none, [](const CaseOutcome& one) { return isAlarm(one); }), Goal::kAtMost,
       0.03},
      {"… that name a cause",
       proportion(none, [](const CaseOutcome& one) { return firstCause(withoutTexture(one)) != nullptr; })},
      {"both of two", proportion(two, [](const CaseOutcome& one) { return scoreTwo(one).both(); }),
       Goal::kAtLeast, 0.80},
      {"… honest ties counted",
       proportion(two, [](const CaseOutcome& one) { return scoreTwo(one).bothWithTies(); })},
      {"… at least one of two",
       proportion(two, [](const CaseOutcome& one) { return scoreTwo(one).right() > 0; })}};
  const auto unexplained = [&](auto&& belongs) {
    Proportion result;
    for (const CaseOutcome* one : uncovered)
      if (belongs(one->of.effect)) result.add(one->answer.verdict == "unexplained");
    return result;
  };
  aims.push_back({"\"unexplained\" of vibration and spring", unexplained([](const std::string& effect) {
                    return effect == kUncoveredNames[0] || effect == kUncoveredNames[1];
                  }),
                  Goal::kAtLeast, 0.80});
  for (const char* name : kUncoveredNames)
    aims.push_back({std::string("… of ") + name,
                    unexplained([&](const std::string& effect) { return effect == name; })});
  return aims;
}

}  // namespace

double Proportion::share() const {
  return trials > 0 ? static_cast<double>(hits) / trials : std::numeric_limits<double>::quiet_NaN();
}

stats::Interval Proportion::interval() const {
  if (trials == 0) return {0.0, 1.0};
  return stats::clopperPearsonInterval(static_cast<std::uint64_t>(hits), static_cast<std::uint64_t>(trials));
}

bool Aim::met() const {
  return goal == Goal::kNone || (goal == Goal::kAtLeast ? result.share() >= aim : result.share() <= aim);
}

int Group::cases() const {
  int sum = 0;
  for (const int count : hits) sum += count;
  return sum;
}

Summary summaryOf(const std::vector<CaseOutcome>& outcomes) {
  Summary summary;
  const auto ones = ofKind(outcomes, Kind::kOne);
  summary.aims = aimsOf(outcomes);
  summary.effects = groupsByEffect(ones);
  summary.groups = otherGroups(ones);
  summary.confusion = confusionOf(outcomes);
  for (const CaseOutcome* outcome : ones)
    for (const NumberCheck& number : scoreOne(*outcome).numbers)
      if (!number.inside()) summary.outside.emplace_back(outcome->of.name(), number);
  for (const CaseOutcome& outcome : outcomes) {
    if (!isRight(outcome))
      summary.misses.push_back({outcome, plantedWords(outcome), saidWords(outcome.answer)});
    summary.seconds.push_back(outcome.answer.seconds);
  }
  std::sort(summary.seconds.begin(), summary.seconds.end());
  return summary;
}

}  // namespace capstan::study
