#include "tests/support/sample_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/resource.h"
#include "core/diagnosis/residuals/decimated_residual.h"
#include "tests/support/sample_motion.h"

namespace capstan::testing {

namespace {

using namespace diagnosis;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

robot::Description leftRaven() { return robot::readDescription(base::resource("robots/raven2_left.yaml")); }

stats::Interval about(double value, double share) { return {value * (1.0 - share), value * (1.0 + share)}; }

Gain gainOf(const ChannelStatistics& before, const ChannelStatistics& after) {
  Gain gain{before.name, before.unit, before.rms, after.rms, {}, {}, {}};
  gain.before = about(before.rms, 0.07), gain.after = about(after.rms, 0.05);
  gain.interval = about(after.rms / before.rms, 0.09);
  return gain;
}

std::vector<Signature> strongestFirst(const Channel& channel, const std::vector<Variable>& variables) {
  std::vector<Signature> all = signaturesOf(channel, variables);
  std::stable_sort(all.begin(), all.end(),
                   [](const Signature& a, const Signature& b) { return a.share > b.share; });
  return all;
}

void addChannels(Report& report, const SampleMotion& motion, const robot::Description& robot, int recording) {
  const auto nominal = residualOf(motion.evidence, motion.nominal, robot);
  const auto refitted = residualOf(motion.evidence, motion.refitted, robot);
  const auto extended = residualOf(motion.evidence, motion.extended, robot);
  const auto before = variablesOf(motion.evidence, motion.refitted, robot);
  const auto after = variablesOf(motion.evidence, motion.extended, robot);
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    ChannelReport channel;
    channel.recording = recording;
    channel.nominal = nominal[i], channel.refitted = refitted[i], channel.extended = extended[i];
    channel.nominal_statistics = statisticsOf(nominal[i]);
    channel.refitted_statistics = statisticsOf(refitted[i]);
    channel.extended_statistics = statisticsOf(extended[i]);
    channel.before = strongestFirst(refitted[i], before);
    channel.after = strongestFirst(extended[i], after);
    channel.gain = gainOf(channel.refitted_statistics, channel.extended_statistics);
    report.channels.push_back(std::move(channel));
    if (report.verdict == Verdict::kUnexplained && recording == 0 && refitted[i].joint == 1)
      report.processes.push_back(
          residualProcess(refitted[i], before, {.points = 200, .iterations = 15, .shuffles = 2}));
  }
}

const Gain& gainOn(const Report& report, const std::string& channel) {
  return std::find_if(report.channels.begin(), report.channels.end(),
                      [&](const ChannelReport& one) { return one.gain.channel == channel; })
      ->gain;
}

Displacements movesOf(int joint, double rms, double tip) {
  Displacements moves{{{}, {}, {0.0, 0.0, true}}, {tip, 2.2 * tip, true}};
  Displacement& moved = moves.joints[static_cast<std::size_t>(joint - 1)];
  moved.rms = rms, moved.largest = 2.2 * rms;
  return moves;
}

Cause backlash(const Report& report, double probability) {
  return {.effect = "backlash",
          .joint = 2,
          .parameters = {{"half_width", "m", 0.93e-3, 0.03e-3, 1.0 / 0.062}},
          .probability = probability,
          .loss = 412.0,
          .moves = movesOf(2, 15e-3, 3.1e-3),
          .gain = gainOn(report, "q2")};
}

/// Tied with the backlash: not in the model, so nothing is simulated with it.
Cause hysteresis(const Report& report, double probability) {
  return {.effect = "cable_hysteresis",
          .joint = 2,
          .parameters = {{"force", "N", 31.0, 4.0}, {"yield", "m", 1.1e-4, 0.6e-4}},
          .probability = probability,
          .gain = gainOn(report, "q2")};
}

Cause eccentricity(const Report& report, double probability) {
  return {.effect = "capstan_eccentricity",
          .joint = 1,
          .parameters = {{"sine", "m", 2e-5, 1e-5}, {"cosine", "m", 0.41e-3, 0.012e-3}},
          .probability = probability,
          .loss = 190.0,
          .moves = movesOf(1, 6e-3, 1.2e-3),
          .gain = gainOn(report, "q1")};
}

/// Below the tolerance.
Cause asymmetry(const Report& report) {
  return {.effect = "asymmetric_friction",
          .joint = 1,
          .parameters = {{"share", "", 0.04, 0.01}},
          .probability = 0.88,
          .loss = 6.2,
          .moves = movesOf(1, 1.2e-4, 2.4e-5),
          .gain = gainOn(report, "q1")};
}

void addPosterior(Report& report) {
  const bool tied = report.verdict == Verdict::kTie;
  std::vector<NamedEffect> best, other;
  for (const Cause& cause : report.causes) best.push_back({cause.effect, cause.joint});
  other = best;
  if (tied) other = {{"cable_hysteresis", 2}};
  for (const Cause& cause : report.also_measurable) best.push_back({cause.effect, cause.joint});
  if (best.empty()) {
    report.posterior = {{{}, 0.96}, {{{"backlash", 2}}, 0.02}};
    return;
  }
  report.posterior = {{best, tied ? 0.55 : 0.87}, {other, tied ? 0.43 : 0.1}};
}

/// Of the joints' encoders. In an unexplained report, a Gaussian process explains more of q1 than the effects
/// do.
void addExplainable(Report& report) {
  const bool some = !report.causes.empty();
  for (const ChannelReport& channel : report.channels) {
    if (channel.recording > 0 || channel.refitted.joint == 0) continue;
    const double before = channel.refitted_statistics.rms, after = channel.extended_statistics.rms;
    Explainable one{.channel = channel.refitted.name,
                    .unit = channel.refitted.unit,
                    .noise = channel.refitted.noise,
                    .refitted = before,
                    .named = some ? after : before,
                    .linear = kNaN,
                    .flexible = kNaN,
                    .share = kNaN,
                    .leans_on = {}};
    if (some || report.verdict == Verdict::kUnexplained) {
      one.linear = std::min(0.9 * before, 1.4 * after);
      one.flexible = std::min(0.8 * before, 0.95 * after);
      one.share = std::min(
          1.0, (before * before - one.named * one.named) / (before * before - one.flexible * one.flexible));
      one.leans_on = "depends on position and direction of joint " + std::to_string(channel.refitted.joint);
    }
    report.explainable.push_back(one);
  }
}

void addCauses(Report& report) {
  switch (report.verdict) {
    case Verdict::kFound:
      report.causes = {backlash(report, 0.97)};
      report.summary =
          "Backlash of joint 2: half a width of 0.93 ± 0.03 mm takes most of what the simulation of q2 gets "
          "wrong off.";
      break;
    case Verdict::kSeveral:
      report.causes = {backlash(report, 0.97), eccentricity(report, 0.91)};
      report.summary = "Two effects: backlash of joint 2 and an eccentric capstan of joint 1.";
      break;
    case Verdict::kTie:
      report.causes = {backlash(report, 0.55)};
      report.ties = {{{backlash(report, 0.55), hysteresis(report, 0.43)},
                      "Reverse joint 2 after strokes of different lengths, slowly and under two loads."}};
      report.summary = "Backlash or cable hysteresis of joint 2: this recording cannot distinguish them.";
      break;
    case Verdict::kNothing:
      report.summary = "Nothing material: what remains after the refit is close to the sensors' noise.";
      break;
    case Verdict::kUnexplained:
      report.summary =
          "Something is there that no hypothesis explains: it goes with the position of joint 1, and joint 3 "
          "vibrates at 7.3 Hz.";
      report.lines = {{"q3", kSampleVibration, 4e-4, 3e-9}};
      break;
  }
  if (!report.causes.empty()) report.also_measurable = {asymmetry(report)};
  report.explained = report.causes.empty() ? 0.0 : 0.9;
}

void addCandidates(Report& report) {
  const bool some = !report.causes.empty();
  report.candidates = {
      {"backlash", 2, 1, some ? 0.93 : 0.004, true, some ? 0.91 : 0.001, some ? 412.0 : -1.2,
       some ? 0.97 : 0.02},
      {"cable_hysteresis", 2, 1, some ? 0.81 : 0.003, true, some ? 0.74 : 0.0, some ? 260.0 : -2.0, 0.02},
      {"asymmetric_friction", 1, 1, 0.02, true, 0.011, 0.8, 0.01},
      {"gravity_tilt", 0, 1, 0.01, false, kNaN, kNaN, 0.0}};
  if (report.verdict == Verdict::kSeveral) {
    report.candidates.push_back({"capstan_eccentricity", 1, 2, 0.88, true, 0.83, 190.0, 0.91});
    report.candidates.push_back({"pulley_radius", 1, 2, 0.05, true, 0.02, 1.5, 0.03});
  }
}

void addRefit(Report& report, const robot::Description& nominal) {
  const double stiffness = nominal.drives[1].cable_stiffness;
  const double coulomb = nominal.joints[0].friction.coulomb;
  const double mass = nominal.joints[2].link.mass;
  report.refit = {{"cable_stiffness of joint 2", "N", stiffness, 0.82 * stiffness, 0.01 * stiffness, false,
                   true, 0.71 * stiffness},
                  {"coulomb friction of joint 1", "N*m", coulomb, 1.02 * coulomb, 0.02 * coulomb, false,
                   false, 1.1 * coulomb},
                  {"mass of link 3", "kg", mass, 1.3 * mass, 0.01 * mass, true, true, 1.3 * mass}};
  report.refit[0].moves = movesOf(2, 15e-3, 3.1e-3), report.refit[0].material = true;
  report.refitted = report.extended = nominal;
  for (robot::Description* robot : {&report.refitted, &report.extended})
    robot->drives[1].cable_stiffness = 0.82 * stiffness;
}

}  // namespace

diagnosis::Evidence sampleEvidence(const SampleDiagnosis& sample, int recording) {
  return sampleMotion(sample, recording, leftRaven()).evidence;
}

diagnosis::Report sampleReport(const SampleDiagnosis& sample) {
  const robot::Description robot = leftRaven();
  Report report;
  report.verdict = sample.verdict;
  for (int recording = 0; recording < sample.recordings; ++recording) {
    const SampleMotion motion = sampleMotion(sample, recording, robot);
    report.recordings.push_back(motion.evidence.title);
    addChannels(report, motion, robot, recording);
  }
  addRefit(report, robot);
  addCauses(report);
  addPosterior(report);
  addExplainable(report);
  addCandidates(report);
  if (!report.causes.empty())
    report.filter = {{"q1", "rad", 0.012, 0.011, 0.0108},
                     {"q2", "rad", 0.021, 0.019, 0.0079},
                     {"q3", "m", 1.6e-3, 1.5e-3, 1.5e-3}};
  report.stages = {{"refit", 3.1}, {"screening", 1.4}, {"selection", 6.2}, {"judging", 2.0}};
  report.notices = {"slow.csv: 12 rows were interpolated over"};
  return report;
}

}  // namespace capstan::testing
