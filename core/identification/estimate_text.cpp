#include "core/identification/estimate_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace capstan::identification {
namespace {

using Names = std::vector<std::string>;

Names seenOf(const std::vector<Estimate>& estimates) {
  Names names;
  for (const Estimate& estimate : estimates)
    if (estimate.seen) names.push_back(estimate.parameter.name());
  return names;
}

Names weakFor(const std::vector<Estimate>& estimates, Weakness reason) {
  Names names;
  for (const Estimate& estimate : estimates)
    if (!estimate.seen && estimate.weakness == reason) names.push_back(estimate.parameter.name());
  return names;
}

/// "a", "a and b", "a, b and c".
std::string listOf(const Names& names) {
  if (names.size() < 2) return names.empty() ? "" : names.front();
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

/// Verb phrases of one parameter and of several.
struct Phrase {
  Weakness reason;
  const char *one, *several;
};
constexpr std::array kPhrases = {
    Phrase{Weakness::kNoObservations, "has no camera observation", "have no camera observation"},
    Phrase{Weakness::kSmallEffect, "has too small an effect in this motion",
           "have too small an effect in this motion"},
    Phrase{Weakness::kCorrelated, "cannot be distinguished from another unknown in this motion",
           "cannot be distinguished from other unknowns in this motion"},
    Phrase{Weakness::kNoBetter, "is known no better than before the recording",
           "are known no better than before the recording"},
    Phrase{Weakness::kHidden, "is hidden by friction and hysteresis that the model does not contain",
           "are hidden by friction and hysteresis that the model does not contain"}};

}  // namespace

std::string keptText(const std::vector<Estimate>& estimates) {
  const std::size_t seen = seenOf(estimates).size(), weak = estimates.size() - seen;
  if (weak == 0) return {};
  Names reasons;
  for (const Phrase& phrase : kPhrases)
    if (const Names names = weakFor(estimates, phrase.reason); !names.empty())
      reasons.push_back(listOf(names) + " " + (names.size() == 1 ? phrase.one : phrase.several));
  const char* who = seen == 0   ? "All parameters keep their values"
                    : weak == 1 ? "The other parameter keeps its value"
                                : "The other parameters keep their values";
  return reasons.empty() ? fmt::format("{}.", who) : fmt::format("{}: {}.", who, fmt::join(reasons, "; "));
}

std::string identifiedText(const std::vector<Estimate>& estimates) {
  const Names seen = seenOf(estimates);
  const std::string kept = keptText(estimates);
  if (seen.empty()) return "No parameter is observable in this motion. " + kept;
  return fmt::format("The value{} of {} {} identified.{}{}", seen.size() == 1 ? "" : "s", listOf(seen),
                     seen.size() == 1 ? "is" : "are", kept.empty() ? "" : " ", kept);
}

std::string acceptText(const std::vector<Estimate>& estimates) {
  const Names seen = seenOf(estimates);
  if (seen.empty())
    return "No parameter is observable so far, so there is nothing to accept. Collect longer, or press "
           "Better "
           "motion.";
  if (seen.size() == estimates.size()) return fmt::format("Accept takes {}.", listOf(seen));
  return fmt::format("Accept takes {} of {} values: {}. The others keep their values.", seen.size(),
                     estimates.size(), listOf(seen));
}

}  // namespace capstan::identification
