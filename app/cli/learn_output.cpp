#include "app/cli/learn_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/learning/poses/related_streams.h"

namespace capstan::cli {
namespace {

using learning::Reason;
using learning::StreamKind;
using Json = nlohmann::json;

constexpr double kMillimetres = 1e3, kDegrees = 180.0 / std::numbers::pi;

/// Reasons of rejection, each with its number of rows or states.
using ReasonCounts = std::vector<std::pair<Reason, std::size_t>>;

template <class Count>
ReasonCounts countsOf(Count count) {
  ReasonCounts counts;
  for (const auto& [reason, name] : base::NamesOf<Reason>::value)
    if (const std::size_t n = reason == Reason::kNone ? 0 : count(reason); n > 0)
      counts.emplace_back(reason, n);
  return counts;
}

Json jsonOf(const ReasonCounts& counts) {
  Json json = Json::object();
  for (const auto& [reason, n] : counts) json[std::string(base::keyOf(reason))] = n;
  return json;
}

std::string wordsOf(const ReasonCounts& counts) {
  std::string words;
  for (const auto& [reason, n] : counts)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n, base::nameOf(reason));
  return words.empty() ? "none" : words;
}

ReasonCounts rejectedOf(const learning::ScreenReport& screen, StreamKind stream) {
  return countsOf([&](Reason reason) { return screen.count(stream, reason); });
}

Json screenJson(const learning::ScreenReport& screen) {
  Json json = Json::object();
  for (const auto& [stream, name] : base::NamesOf<StreamKind>::value) {
    const auto at = static_cast<std::size_t>(stream);
    json[std::string(name)] = {{"rows", screen.rows[at]},
                               {"poses", screen.poses[at]},
                               {"rejected", jsonOf(rejectedOf(screen, stream))}};
  }
  return json;
}

std::string screenText(const learning::ScreenReport& screen) {
  std::string text;
  for (const auto& [stream, name] : base::NamesOf<StreamKind>::value) {
    const auto at = static_cast<std::size_t>(stream);
    if (screen.rows[at] == 0) continue;
    text += fmt::format("  {:8} {} of {} rows are poses; rejected: {}\n", name, screen.poses[at],
                        screen.rows[at], wordsOf(rejectedOf(screen, stream)));
  }
  return text;
}

Json errorJson(const learning::CorrectionErrors& error) {
  const auto mean = [&](double x) { return error.states > 0 ? x : NAN; };
  return {{"distance", {{"mean", mean(error.distance)}, {"median", error.median_distance}}},
          {"angle", {{"mean", mean(error.angle)}, {"median", error.median_angle}}}};
}

Json stepsJson(std::size_t states, const learning::StepErrors& steps) {
  Json json = {{"states", states}};
  for (const auto& [step, name] : base::NamesOf<learning::CorrectionStep>::value)
    json[std::string(name)] = errorJson(steps[static_cast<std::size_t>(step)].summed());
  return json;
}

std::string stepsText(const char* name, std::size_t states, const learning::StepErrors& steps) {
  std::string text = fmt::format("  {} ({} states)\n", name, states);
  if (states == 0) return text;
  constexpr std::array kWords = {"not corrected", "rigid offset", "corrected"};
  for (std::size_t s = 0; s < learning::kCorrectionSteps; ++s) {
    const learning::CorrectionErrors error = steps[s].summed();
    text += fmt::format("    {:16}{:8.2f} mm {:8.2f} deg   median {:8.2f} mm {:8.2f} deg\n", kWords[s],
                        kMillimetres * error.distance, kDegrees * error.angle,
                        kMillimetres * error.median_distance, kDegrees * error.median_angle);
  }
  return text;
}

std::string evaluationText(const learning::Evaluation& errors) {
  return stepsText("all", errors.states, errors.all) + stepsText("clean", errors.clean_states, errors.clean);
}

void addEvaluation(Json& json, const learning::Evaluation& errors) {
  json["all"] = stepsJson(errors.states, errors.all);
  json["clean"] = stepsJson(errors.clean_states, errors.clean);
}

std::string motionText(learning::Motion motion) {
  switch (motion) {
    case learning::Motion::kNone:
      return " alone";
    case learning::Motion::kVelocity:
      return " and its velocity";
    default:
      return fmt::format(", its velocity and its motion in the last {} s", learning::kSpans.back());
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
      "Gaussian processes of the pose{}: {} each of x, y, z and the rotation, with {} inducing points\n",
      motionText(model.motion()), members.size(), members.front().inducing());
}

/// Text " ± σ"; empty for a single trajectory, which has no σ.
std::string sigmaText(double sigma) { return sigma > 0.0 ? fmt::format(" ± {:.1f}", sigma) : ""; }

/// Reasons for which the readmitted states had been rejected.
ReasonCounts againCounts(const learning::WeighingReport& weighing) {
  return countsOf(
      [&](Reason reason) { return static_cast<std::size_t>(std::ranges::count(weighing.again, reason)); });
}

std::string weighingText(const learning::WeighingReport& weighing) {
  if (!weighing.weighed) return "Weights: all states have the same weight\n";
  return fmt::format(
      "Weights: {} states down-weighted, because models of other trajectories contradict them\n"
      "         {} rejected states readmitted, because models of other trajectories agree; they were: {}\n",
      weighing.down_weighted, weighing.again.size(), wordsOf(againCounts(weighing)));
}

}  // namespace

TestReport testedOn(const std::vector<learning::RawMotion>& motions, const learning::LearningReport& report,
                    const learning::LearningOptions& options) {
  TestReport test{learning::prepareAt(report.prepared.removed, motions, options.towards), {}};
  const std::vector<learning::State>& states = test.prepared.states;
  learning::checkRelated(test.prepared.screen.motions, states, report.model.offset(), options.towards);
  test.errors = learning::evaluate(report, states, options);
  return test;
}

std::string textOf(const LearnOutput& output) {
  const learning::PreparedStates& prepared = output.report.prepared;
  const learning::CleaningReport& cleaning = output.report.cleaning;
  std::string text = "Screening\n" + screenText(prepared.screen);
  if (prepared.clock_offset.tried.empty())
    text +=
        fmt::format("Alignment: the model's clock offset of {:.1f} ms subtracted\n", 1e3 * prepared.removed);
  else
    text +=
        fmt::format("Clock offset: observations {:.1f}{} ms behind commands{}\n",
                    1e3 * prepared.clock_offset.clock_offset, sigmaText(1e3 * prepared.clock_offset.sigma),
                    prepared.removed == 0.0 ? ", not subtracted" : "");
  text += fmt::format("Cleaning and weights: {} of {} states count; excluded: {}\n", cleaning.kept(),
                      cleaning.reason.size(),
                      wordsOf(countsOf([&](Reason reason) { return cleaning.count(reason); })));
  text += weighingText(output.report.weighing);
  const Eigen::Vector3d t = kMillimetres * output.report.model.offset().translation();
  const double rotation = Eigen::AngleAxisd(output.report.model.offset().linear()).angle();
  text += fmt::format("Rigid offset: {:.2f}, {:.2f}, {:.2f} mm and a rotation of {:.2f} deg\n", t.x(), t.y(),
                      t.z(), kDegrees * rotation);
  if (!output.report.model.processes().empty()) text += processesText(output.report.model);
  if (output.held_out)
    text += fmt::format("Errors on {} of {} trajectories, held out from training, mean\n",
                        output.held_out->motions_held, output.held_out->motions) +
            evaluationText(output.held_out->test);
  if (output.test) text += "Errors on the test tables, mean\n" + evaluationText(output.test->errors);
  return text;
}

Json jsonOf(const LearnOutput& output) {
  const learning::PreparedStates& prepared = output.report.prepared;
  const learning::CleaningReport& cleaning = output.report.cleaning;
  Json json = {{"screening", screenJson(prepared.screen)},
               {"clock_offset",
                {{"value", prepared.clock_offset.clock_offset},
                 {"sigma", prepared.clock_offset.sigma > 0.0 ? prepared.clock_offset.sigma : NAN},
                 {"removed", prepared.removed}}},
               {"cleaning",
                {{"states", cleaning.reason.size()},
                 {"kept", cleaning.kept()},
                 {"rejected", jsonOf(countsOf([&](Reason reason) { return cleaning.count(reason); }))}}},
               {"weights",
                {{"weighed", output.report.weighing.weighed},
                 {"down_weighted", output.report.weighing.down_weighted},
                 {"readmitted", jsonOf(againCounts(output.report.weighing))}}},
               {"model", modelJson(output.report.model)}};
  if (output.test) {
    json["test"]["screening"] = screenJson(output.test->prepared.screen);
    addEvaluation(json["test"], output.test->errors);
  }
  if (output.held_out) {
    json["held_out"] = {{"trajectories", output.held_out->motions},
                        {"held_out", output.held_out->motions_held}};
    addEvaluation(json["held_out"], output.held_out->test);
  }
  return json;
}

}  // namespace capstan::cli
