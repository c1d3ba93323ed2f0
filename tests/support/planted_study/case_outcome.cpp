#include "tests/support/planted_study/case_outcome.h"

#include <stdexcept>

namespace capstan::study {
namespace {

using nlohmann::json;

json jsonOf(const test::Planted& planted) {
  return {{"effect", test::factsOf(planted.effect).name},
          {"joint", planted.joint + 1},
          {"magnitude", planted.magnitude},
          {"unit", test::factsOf(planted.effect).magnitude},
          {"signature", planted.signature},
          {"phase", planted.phase},
          {"other", planted.other + 1},
          {"axis", {planted.axis.x(), planted.axis.y(), planted.axis.z()}}};
}

test::Planted plantedFrom(const json& from) {
  const auto name = from.at("effect").get<std::string>();
  const test::EffectFacts* facts = test::effectNamed(name);
  if (!facts) throw std::invalid_argument("no effect " + name);
  test::Planted planted;
  planted.effect = facts->effect;
  planted.joint = from.at("joint").get<int>() - 1;
  from.at("magnitude").get_to(planted.magnitude);
  from.at("signature").get_to(planted.signature);
  from.at("phase").get_to(planted.phase);
  planted.other = from.at("other").get<int>() - 1;
  const auto axis = from.at("axis").get<std::array<double, 3>>();
  planted.axis = {axis[0], axis[1], axis[2]};
  return planted;
}

template <class Enum>
Enum named(const json& from) {
  const auto name = from.get<std::string>();
  const auto value = base::fromName<Enum>(name);
  if (!value) throw std::invalid_argument("unknown word " + name);
  return *value;
}

json jsonOf(const HiddenTruth& truth) {
  json items = json::array(), texture = json::array();
  for (const auto& item : truth.items)
    items.push_back({{"effect", item.effect},
                     {"joint", item.joint},
                     {"size", item.size},
                     {"visibility", item.visibility},
                     {"planted", jsonOf(item.planted)}});
  for (const auto& one : truth.texture) texture.push_back(jsonOf(one));
  return {{"effects", std::move(items)},
          {"texture", std::move(texture)},
          {"duration", truth.duration},
          {"ideal_limit", numberOrNull(truth.ideal_limit)}};
}

HiddenTruth truthFrom(const json& from) {
  HiddenTruth truth;
  for (const json& one : from.at("effects"))
    truth.items.push_back({one.at("effect").get<std::string>(), one.at("joint").get<int>(),
                           one.at("size").get<double>(), one.at("visibility").get<double>(),
                           plantedFrom(one.at("planted"))});
  for (const json& one : from.at("texture")) truth.texture.push_back(plantedFrom(one));
  from.at("duration").get_to(truth.duration);
  truth.ideal_limit = numberOrNan(from.at("ideal_limit"));
  return truth;
}

}  // namespace

json jsonOf(const CaseOutcome& outcome) {
  return {{"case",
           {{"kind", base::nameOf(outcome.of.kind)},
            {"robot", base::nameOf(outcome.of.robot)},
            {"effect", outcome.of.effect},
            {"seed", outcome.of.seed},
            {"population", base::nameOf(outcome.of.population)}}},
          {"truth", jsonOf(outcome.truth)},
          {"answer", jsonOf(outcome.answer)}};
}

CaseOutcome outcomeFrom(const json& from) {
  const json& of = from.at("case");
  return {{named<Kind>(of.at("kind")), named<Robot>(of.at("robot")), of.at("effect").get<std::string>(),
           of.at("seed").get<std::uint64_t>(), named<Population>(of.at("population"))},
          truthFrom(from.at("truth")),
          answerFrom(from.at("answer"))};
}

}  // namespace capstan::study
