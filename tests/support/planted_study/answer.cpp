#include "tests/support/planted_study/answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capstan::study {
namespace {

using nlohmann::json;

NamedCause namedFrom(const diagnosis::Cause& cause) {
  NamedCause named{cause.effect, cause.joint, cause.probability, {}};
  for (const auto& parameter : cause.parameters)
    named.numbers.push_back({parameter.name, parameter.value, parameter.sigma});
  return named;
}

json jsonOf(const std::vector<NamedCause>& causes) {
  json list = json::array();
  for (const NamedCause& cause : causes) {
    json numbers = json::array();
    for (const FoundNumber& number : cause.numbers)
      numbers.push_back({{"name", number.name},
                         {"value", numberOrNull(number.value)},
                         {"sigma", numberOrNull(number.sigma)}});
    list.push_back({{"effect", cause.effect},
                    {"joint", cause.joint},
                    {"probability", numberOrNull(cause.probability)},
                    {"numbers", std::move(numbers)}});
  }
  return list;
}

std::vector<NamedCause> causesFrom(const json& list) {
  std::vector<NamedCause> causes;
  for (const json& one : list) {
    NamedCause& cause = causes.emplace_back();
    one.at("effect").get_to(cause.effect);
    one.at("joint").get_to(cause.joint);
    cause.probability = numberOrNan(one.at("probability"));
    for (const json& number : one.at("numbers"))
      cause.numbers.push_back({number.at("name").get<std::string>(), numberOrNan(number.at("value")),
                               numberOrNan(number.at("sigma"))});
  }
  return causes;
}

}  // namespace

json numberOrNull(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

double numberOrNan(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Answer answerOf(const diagnosis::Report& report, double seconds) {
  Answer answer;
  answer.verdict = base::nameOf(report.verdict);
  answer.summary = report.summary;
  answer.explained = report.explained;
  answer.seconds = seconds;
  for (const auto& cause : report.causes) answer.causes.push_back(namedFrom(cause));
  for (const auto& tie : report.ties) {
    std::vector<NamedCause>& causes = answer.ties.emplace_back();
    for (const auto& cause : tie.causes) causes.push_back(namedFrom(cause));
  }
  for (const auto& candidate : report.candidates)
    if (candidate.round == 1)
      answer.candidates.push_back({candidate.effect, candidate.joint, candidate.reduction, candidate.score});
  const auto rank = [](const RankedCause& one) { return std::isfinite(one.score) ? one.score : -HUGE_VAL; };
  std::stable_sort(answer.candidates.begin(), answer.candidates.end(),
                   [&](const RankedCause& a, const RankedCause& b) { return rank(a) > rank(b); });
  answer.candidates.resize(std::min(answer.candidates.size(), kRanked));
  return answer;
}

json jsonOf(const Answer& answer) {
  json ties = json::array(), candidates = json::array();
  for (const auto& tie : answer.ties) ties.push_back(jsonOf(tie));
  for (const RankedCause& one : answer.candidates)
    candidates.push_back({{"effect", one.effect},
                          {"joint", one.joint},
                          {"reduction", numberOrNull(one.reduction)},
                          {"score", numberOrNull(one.score)}});
  return {{"verdict", answer.verdict},
          {"summary", answer.summary},
          {"causes", jsonOf(answer.causes)},
          {"ties", std::move(ties)},
          {"candidates", std::move(candidates)},
          {"explained", numberOrNull(answer.explained)},
          {"seconds", answer.seconds}};
}

Answer answerFrom(const json& from) {
  Answer answer;
  from.at("verdict").get_to(answer.verdict);
  from.at("summary").get_to(answer.summary);
  answer.causes = causesFrom(from.at("causes"));
  for (const json& tie : from.at("ties")) answer.ties.push_back(causesFrom(tie));
  for (const json& one : from.at("candidates"))
    answer.candidates.push_back({one.at("effect").get<std::string>(), one.at("joint").get<int>(),
                                 numberOrNan(one.at("reduction")), numberOrNan(one.at("score"))});
  answer.explained = numberOrNan(from.at("explained"));
  from.at("seconds").get_to(answer.seconds);
  return answer;
}

}  // namespace capstan::study
