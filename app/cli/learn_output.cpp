#include "app/cli/learn_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/learning/poses/related_streams.h"

namespace capstan::cli {
namespace {

using learning::Reason;
using learning::StreamKind;
using Json = nlohmann::json;

constexpr double kMillimetres = 1e3, kDegrees = 180.0 / std::numbers::pi;

TestedStates testedStates(const std::vector<learning::State>& states,
                          const learning::CorrectionModel& model) {
  TestedStates tested;
  tested.states = states.size();
  const std::vector<Eigen::Isometry3d> corrected = model.correct(states);
  learning::PoseErrors none, offset, by_model;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto& [seen, told] = states[k].pair;
    none.add(seen, told);
    offset.add(model.offset() * seen, told);
    by_model.add(corrected[k], told);
  }
  tested.none = none.summed(), tested.offset = offset.summed(), tested.corrected = by_model.summed();
  return tested;
}

/// Reasons and how many rows or states have them.
template <class Count>
Json countsOf(Count count) {
  Json json = Json::object();
  for (const auto& [reason, name] : base::NamesOf<Reason>::value)
    if (const std::size_t n = reason == Reason::kNone ? 0 : count(reason); n > 0) json[std::string(name)] = n;
  return json;
}

std::string wordsOf(const Json& counts) {
  std::string words;
  for (const auto& [name, n] : counts.items())
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n.template get<std::size_t>(), name);
  return words.empty() ? "none" : words;
}

Json screenJson(const learning::ScreenReport& screen) {
  Json json = Json::object();
  for (const auto& [kind, name] : base::NamesOf<StreamKind>::value) {
    const auto at = static_cast<std::size_t>(kind);
    const StreamKind stream = kind;
    json[std::string(name)] = {
        {"rows", screen.rows[at]},
        {"poses", screen.poses[at]},
        {"rejected", countsOf([&](Reason reason) { return screen.count(stream, reason); })}};
  }
  return json;
}

std::string screenText(const learning::ScreenReport& screen) {
  std::string text;
  const Json json = screenJson(screen);
  for (const auto& [kind, name] : base::NamesOf<StreamKind>::value) {
    const Json& one = json[std::string(name)];
    if (one["rows"] == 0) continue;
    text +=
        fmt::format("  {:8} {} of {} rows are poses; left out: {}\n", name, one["poses"].get<std::size_t>(),
                    one["rows"].get<std::size_t>(), wordsOf(one["rejected"]));
  }
  return text;
}

Json errorJson(const learning::CorrectionErrors& error) {
  const auto mean = [&](double x) { return error.states > 0 ? x : NAN; };
  return {{"distance", {{"mean", mean(error.distance)}, {"median", error.median_distance}}},
          {"angle", {{"mean", mean(error.angle)}, {"median", error.median_angle}}}};
}

Json testedJson(const TestedStates& tested) {
  return {{"states", tested.states},
          {"none", errorJson(tested.none)},
          {"offset", errorJson(tested.offset)},
          {"corrected", errorJson(tested.corrected)}};
}

std::string testedText(const char* name, const TestedStates& tested) {
  std::string text = fmt::format("  {} ({} states)\n", name, tested.states);
  if (tested.states == 0) return text;
  const auto line = [&](const char* what, const learning::CorrectionErrors& error) {
    text += fmt::format("    {:16}{:8.2f} mm {:8.2f} deg   median {:8.2f} mm {:8.2f} deg\n", what,
                        kMillimetres * error.distance, kDegrees * error.angle,
                        kMillimetres * error.median_distance, kDegrees * error.median_angle);
  };
  line("not corrected", tested.none);
  line("rigid offset", tested.offset);
  line("corrected", tested.corrected);
  return text;
}

std::string motionText(learning::Motion motion) {
  switch (motion) {
    case learning::Motion::kNone:
      return " alone";
    case learning::Motion::kVelocity:
      return " and its velocity";
    default:
      return fmt::format(", its velocity and how it moved in the last {} s", learning::kSpans.back());
  }
}

Json modelJson(const learning::CorrectionModel& model) {
  const Eigen::Vector3d t = model.offset().translation();
  const Eigen::Vector4d q = Eigen::Quaterniond(model.offset().linear()).coeffs();
  Json json = {{"offset", {{"position", {t.x(), t.y(), t.z()}}, {"quaternion", {q[0], q[1], q[2], q[3]}}}},
               {"motion", base::nameOf(model.motion())},
               {"processes", Json::array()}};
  for (const learning::Committee& committee : model.processes()) {
    Json members = Json::array();
    for (const learning::SparseProcess& member : committee.members()) {
      const Eigen::VectorXd lengths = member.parameters().ln_length.array().exp();
      members.push_back({{"inducing", member.inducing()},
                         {"signal", std::exp(member.parameters().ln_signal)},
                         {"noise", std::exp(member.parameters().ln_noise)},
                         {"lengths", std::vector<double>(lengths.begin(), lengths.end())}});
    }
    json["processes"].push_back({{"kernel", base::nameOf(committee.members().front().parameters().kernel)},
                                 {"outputs", committee.outputs()},
                                 {"members", std::move(members)}});
  }
  return json;
}

std::string processesText(const learning::CorrectionModel& model) {
  const auto& members = model.processes().front().members();
  return fmt::format(
      "Gaussian processes of the pose{}: {} each of x, y, z and the turn, with {} inducing points\n",
      motionText(model.motion()), members.size(), members.front().inducing());
}

/// Of one trajectory there is none.
std::string sigmaText(double sigma) { return sigma > 0.0 ? fmt::format(" ± {:.1f}", sigma) : ""; }

/// Why those had been left out that count again.
Json againCounts(const learning::WeighingReport& weighing) {
  return countsOf(
      [&](Reason reason) { return static_cast<std::size_t>(std::ranges::count(weighing.again, reason)); });
}

std::string weighingText(const learning::WeighingReport& weighing) {
  if (!weighing.weighed) return "Weights: none, all that count do so alike\n";
  return fmt::format(
      "Weights: {} states doubted, which other trajectories contradict: they count less\n"
      "         {} that were left out count again, which others tell the same; they were: {}\n",
      weighing.doubted, weighing.again.size(), wordsOf(againCounts(weighing)));
}

}  // namespace

TestReport testedOn(const std::vector<learning::RawMotion>& motions, const learning::LearningReport& report,
                    const learning::LearningOptions& options) {
  TestReport test{};
  test.prepared.screen = learning::screenPoses(motions);
  test.prepared.taken_off = report.prepared.taken_off;
  test.prepared.states =
      learning::statesOf(test.prepared.screen.motions, options.towards, report.prepared.taken_off);
  const std::vector<learning::State>& states = test.prepared.states;
  learning::checkRelated(test.prepared.screen.motions, states, report.model.offset(), options.towards);
  test.all = testedStates(states, report.model);
  const learning::CleaningReport limits =
      options.clean ? report.cleaning : learning::cleanStates(report.prepared.states, options.cleaning);
  learning::CleaningReport judged;
  judged.reason = learning::judgedBy(limits, states, options.cleaning);
  test.clean = testedStates(learning::kept(states, judged), report.model);
  return test;
}

std::string textOf(const LearnOutput& output) {
  const learning::PreparedStates& prepared = output.report.prepared;
  const learning::CleaningReport& cleaning = output.report.cleaning;
  std::string text = "Screening\n" + screenText(prepared.screen);
  if (prepared.lag.tried.empty())
    text += fmt::format("Alignment: the model's lag of {:.1f} ms taken off\n", 1e3 * prepared.taken_off);
  else
    text += fmt::format("Alignment: what is seen comes {:.1f}{} ms behind what is told{}\n",
                        1e3 * prepared.lag.lag, sigmaText(1e3 * prepared.lag.sigma),
                        prepared.taken_off == 0.0 ? ", not taken off" : "");
  text += fmt::format("Cleaning and weights: {} of {} states count; left out: {}\n", cleaning.kept(),
                      cleaning.reason.size(),
                      wordsOf(countsOf([&](Reason reason) { return cleaning.count(reason); })));
  text += weighingText(output.report.weighing);
  const Eigen::Vector3d t = kMillimetres * output.report.model.offset().translation();
  const double turn = Eigen::AngleAxisd(output.report.model.offset().linear()).angle();
  text += fmt::format("Rigid offset: {:.2f}, {:.2f}, {:.2f} mm and a turn of {:.2f} deg\n", t.x(), t.y(),
                      t.z(), kDegrees * turn);
  if (!output.report.model.processes().empty()) text += processesText(output.report.model);
  if (!output.test) return text;
  text += "Errors on the test tables, mean\n" + testedText("all", output.test->all) +
          testedText("clean", output.test->clean);
  return text;
}

Json jsonOf(const LearnOutput& output) {
  const learning::PreparedStates& prepared = output.report.prepared;
  const learning::CleaningReport& cleaning = output.report.cleaning;
  Json json = {{"screening", screenJson(prepared.screen)},
               {"lag",
                {{"value", prepared.lag.lag},
                 {"sigma", prepared.lag.sigma > 0.0 ? prepared.lag.sigma : NAN},
                 {"taken_off", prepared.taken_off}}},
               {"cleaning",
                {{"states", cleaning.reason.size()},
                 {"kept", cleaning.kept()},
                 {"rejected", countsOf([&](Reason reason) { return cleaning.count(reason); })}}},
               {"weights",
                {{"weighed", output.report.weighing.weighed},
                 {"doubted", output.report.weighing.doubted},
                 {"again", againCounts(output.report.weighing)}}},
               {"model", modelJson(output.report.model)}};
  if (output.test)
    json["test"] = {{"screening", screenJson(output.test->prepared.screen)},
                    {"all", testedJson(output.test->all)},
                    {"clean", testedJson(output.test->clean)}};
  return json;
}

}  // namespace capstan::cli
