#include "core/diagnosis/report/report_json.h"

#include <algorithm>
#include <cmath>

namespace capstan::diagnosis {
namespace {

using nlohmann::json;

/// Number as JSON; null if it is not finite, since JSON has no NaN.
json number(double value) { return std::isfinite(value) ? json(value) : json(); }

json interval(const stats::Interval& bounds) { return {number(bounds.low), number(bounds.high)}; }

template <class Items, class Write>
json list(const Items& items, Write&& write) {
  json all = json::array();
  for (const auto& item : items) all.push_back(write(item));
  return all;
}

json gainJson(const Gain& gain) {
  return {{"channel", gain.channel},
          {"unit", gain.unit},
          {"rms_before", number(gain.rms_before)},
          {"rms_after", number(gain.rms_after)},
          {"before", interval(gain.before)},
          {"after", interval(gain.after)},
          {"interval", interval(gain.interval)}};
}

json movesJson(const Displacements& moves) {
  const auto one = [](const Displacement& moved) {
    return json{{"rms", number(moved.rms)}, {"largest", number(moved.largest)}};
  };
  return {{"joints", list(moves.joints, one)}, {"tip", one(moves.tip)}};
}

json namesJson(const std::vector<NamedEffect>& effects) {
  return list(effects, [](const NamedEffect& one) {
    return json{{"effect", one.effect}, {"joint", one.joint}};
  });
}

json setJson(const SetProbability& set) {
  return {{"effects", namesJson(set.effects)}, {"probability", number(set.probability)}};
}

json nextJson(const std::optional<NextExperiment>& next) {
  if (!next) return json();
  return {{"motion", next->motion},
          {"duration", next->t.empty() ? 0.0 : next->t.back()},
          {"distinguishes", namesJson(next->distinguishes)},
          {"confusion_now", number(next->confusion_now)},
          {"confusion_after", number(next->confusion_after)}};
}

json tieJson(const Tie& tie) {
  return {{"causes", list(tie.causes, [](const Cause& cause) { return jsonOf(cause); })},
          {"separate", tie.separate}};
}

/// "cable_stiffness of joint 2" as a key: "cable_stiffness_2".
std::string keyOf(std::string name) {
  const std::string of = " of joint ";
  if (const auto at = name.find(of); at != std::string::npos) name.replace(at, of.size(), "_");
  std::ranges::replace(name, ' ', '_');
  return name;
}

json refitJson(const std::vector<RefitNumber>& refit) {
  json all = json::object();
  for (const RefitNumber& one : refit)
    all[keyOf(one.name)] = {{"nominal", number(one.nominal)},
                            {"value", number(one.value)},
                            {"sigma", number(one.sigma)},
                            {"without", number(one.value_without)},
                            {"unit", one.unit},
                            {"moved", one.moved},
                            {"material", one.material},
                            {"moves", movesJson(one.moves)},
                            {"at_bound", one.at_bound}};
  return all;
}

json candidateJson(const Candidate& candidate) {
  return {{"effect", candidate.effect},       {"joint", candidate.joint},
          {"round", candidate.round},         {"screened", number(candidate.screened)},
          {"refitted", candidate.refitted},   {"reduction", number(candidate.reduction)},
          {"score", number(candidate.score)}, {"probability", number(candidate.probability)}};
}

json statisticsJson(const ChannelStatistics& statistics) {
  return {{"samples", statistics.samples},
          {"rms", number(statistics.rms)},
          {"mean", number(statistics.mean)},
          {"fit", number(statistics.fit)},
          {"noise", number(statistics.noise)},
          {"beyond_noise", number(statistics.beyond_noise)},
          {"whiteness",
           {{"q", number(statistics.whiteness.q)},
            {"p_value", number(statistics.whiteness.p_value)},
            {"period", number(statistics.whiteness_period)}}},
          {"effective_samples", number(statistics.effective_samples)}};
}

json binJson(const SignatureBin& bin) {
  return {{"low", number(bin.low)},   {"high", number(bin.high)}, {"centre", number(bin.centre)},
          {"mean", number(bin.mean)}, {"samples", bin.samples},   {"interval", interval(bin.interval)}};
}

json signatureJson(const Signature& signature) {
  return {{"variable", signature.variable},
          {"kind", base::nameOf(signature.kind)},
          {"joint", signature.joint},
          {"unit", signature.unit},
          {"share", number(signature.share)},
          {"sigma", number(signature.share_sigma)},
          {"bins", list(signature.bins, binJson)}};
}

json channelJson(const ChannelReport& channel) {
  return {{"recording", channel.recording},
          {"name", channel.refitted.name},
          {"unit", channel.refitted.unit},
          {"joint", channel.refitted.joint},
          {"nominal", statisticsJson(channel.nominal_statistics)},
          {"refitted", statisticsJson(channel.refitted_statistics)},
          {"extended", statisticsJson(channel.extended_statistics)},
          {"before", list(channel.before, signatureJson)},
          {"after", list(channel.after, signatureJson)},
          {"gain", gainJson(channel.gain)}};
}

json processJson(const ResidualProcess& process) {
  return {{"channel", process.channel},
          {"end", base::nameOf(process.end)},
          {"words", process.words},
          {"points", process.points},
          {"explained", number(process.explained)},
          {"amplitude", number(process.amplitude)},
          {"noise", number(process.noise)},
          {"lasting", number(process.lasting)},
          {"memory", number(process.memory)},
          {"variables", list(process.variables, [](const ProcessVariable& one) {
             return json{{"variable", one.name},         {"kind", base::nameOf(one.kind)},
                         {"joint", one.joint},           {"unit", one.unit},
                         {"length", number(one.length)}, {"relevance", number(one.relevance)},
                         {"sigma", number(one.sigma)}};
           })}};
}

json explainableJson(const Explainable& one) {
  return {{"channel", one.channel},           {"unit", one.unit},           {"noise", number(one.noise)},
          {"refitted", number(one.refitted)}, {"named", number(one.named)}, {"linear", number(one.linear)},
          {"flexible", number(one.flexible)}, {"share", number(one.share)}, {"leans_on", one.leans_on}};
}

json lineJson(const SpectralLine& line) {
  return {{"channel", line.channel},
          {"frequency", number(line.frequency)},
          {"amplitude", number(line.amplitude)},
          {"p_value", number(line.p_value)}};
}

json filterJson(const FilterGain& gain) {
  return {{"joint", gain.joint},
          {"unit", gain.unit},
          {"nominal", number(gain.nominal)},
          {"refitted", number(gain.refitted)},
          {"extended", number(gain.extended)}};
}

}  // namespace

json jsonOf(const Cause& cause) {
  json parameters = json::object();
  for (const FoundParameter& parameter : cause.parameters) {
    json& one = parameters[parameter.name];
    one = {{"value", number(parameter.value)},
           {"sigma", number(parameter.sigma)},
           {"unit", parameter.unit},
           {"at_bound", parameter.at_bound}};
    if (const double scale = parameter.joint_per_length; scale != 0.0)
      one["at_joint"] = {{"value", number(scale * parameter.value)},
                         {"sigma", number(scale * parameter.sigma)},
                         {"unit", "rad"}};
  }
  return {{"effect", cause.effect},      {"joint", cause.joint},
          {"parameters", parameters},    {"probability", number(cause.probability)},
          {"loss", number(cause.loss)},  {"moves", movesJson(cause.moves)},
          {"gain", gainJson(cause.gain)}};
}

json jsonOf(const Report& report) {
  return {{"verdict", report.cancelled ? json() : json(base::nameOf(report.verdict))},
          {"summary", report.summary},
          {"explained", number(report.explained)},
          {"cancelled", report.cancelled},
          {"search_complete", report.search_complete},
          {"recordings", report.recordings},
          {"causes", list(report.causes, [](const Cause& cause) { return jsonOf(cause); })},
          {"also_measurable", list(report.also_measurable, [](const Cause& cause) { return jsonOf(cause); })},
          {"uncertain", list(report.uncertain, [](const Cause& cause) { return jsonOf(cause); })},
          {"material", {{"angle", report.material.angle}, {"length", report.material.length}}},
          {"posterior", list(report.posterior, setJson)},
          {"ties", list(report.ties, tieJson)},
          {"next_experiment", nextJson(report.next)},
          {"refit", refitJson(report.refit)},
          {"candidates", list(report.candidates, candidateJson)},
          {"channels", list(report.channels, channelJson)},
          {"explainable", list(report.explainable, explainableJson)},
          {"processes", list(report.processes, processJson)},
          {"lines", list(report.lines, lineJson)},
          {"filter", list(report.filter, filterJson)},
          {"stages", list(report.stages,
                          [](const Stage& stage) {
                            return json{{"name", stage.name}, {"seconds", number(stage.seconds)}};
                          })},
          {"notices", report.notices}};
}

}  // namespace capstan::diagnosis
