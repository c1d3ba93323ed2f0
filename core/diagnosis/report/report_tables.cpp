#include "core/diagnosis/report/report_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "core/base/nan.h"
#include "core/diagnosis/hypotheses/pose_hypotheses.h"
#include "core/diagnosis/report/shown.h"

namespace capstan::diagnosis {
namespace {

using base::NumberStyle;
using base::Table;
using base::TableCell;

base::TableColumn number(std::string name, std::string unit, int digits, NumberStyle style) {
  return {std::move(name), std::move(unit), digits, style, false};
}

std::string percentages(double value, const stats::Interval& interval) {
  if (!std::isfinite(value)) return {};
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high))
    return fmt::format("{:.1f}", 100.0 * value);
  return fmt::format("{:.1f} ({:.1f} … {:.1f})", 100.0 * value, 100.0 * interval.low, 100.0 * interval.high);
}

double ratioOf(const Gain& gain) {
  return gain.rms_before > 0.0 ? gain.rms_after / gain.rms_before : base::kNaN;
}

std::string nameOf(const Channel& channel) {
  return channel.name + " [" + shownUnit(channel.unit).unit + "]";
}

std::string recordingOf(const Report& report, int recording) {
  const auto i = static_cast<std::size_t>(recording);
  return i < report.recordings.size() ? report.recordings[i] : fmt::format("recording {}", recording + 1);
}

/// Probability as it is shown: below 0.5 % it does not decide the order.
double shownProbability(const Candidate& candidate) {
  constexpr double kLeastShown = 0.005;
  return candidate.probability < kLeastShown ? 0.0 : candidate.probability;
}

bool ahead(const Candidate& a, const Candidate& b) {
  if (a.round != b.round) return a.round < b.round;
  if (shownProbability(a) != shownProbability(b)) return a.probability > b.probability;
  if (a.refitted != b.refitted) return a.refitted;
  if (a.refitted && a.score != b.score) return a.score > b.score;
  return a.screened > b.screened;
}

/// True if the model of the report has exactly these effects.
bool isModel(const Report& report, const std::vector<NamedEffect>& effects) {
  const auto has = [&](const Cause& cause) {
    return std::ranges::any_of(effects, [&](const NamedEffect& one) {
      return one.effect == cause.effect && one.joint == cause.joint;
    });
  };
  return hasEffects(report) && effects.size() == report.causes.size() + report.also_measurable.size() &&
         std::ranges::all_of(report.causes, has) && std::ranges::all_of(report.also_measurable, has);
}

}  // namespace

bool hasEffects(const Report& report) { return !report.causes.empty() || !report.also_measurable.empty(); }

std::string titleOf(std::string_view effect) {
  const HypothesisWords* words = wordsOf(effect);
  return std::string(words ? words->title : effect);
}

bool namesItsPlace(std::string_view effect) { return effect.starts_with("camera"); }

std::string titleAndPlace(const std::string& effect, int joint) {
  const std::string title = titleOf(effect);
  return namesItsPlace(effect) ? title : title + ", " + shownJoint(effect, joint);
}

std::string causeText(const Cause& cause) {
  std::string text = titleAndPlace(cause.effect, cause.joint);
  for (const FoundParameter& parameter : cause.parameters)
    text += (&parameter == &cause.parameters.front() ? ": " : ", ") + shownParameter(cause.effect, parameter);
  return text;
}

std::string gainText(const Gain& gain) {
  const double ratio = ratioOf(gain);
  std::string text =
      fmt::format("{}: RMS {} becomes {}", gain.channel, shownNumber(gain.rms_before, 0.0, gain.unit),
                  shownNumber(gain.rms_after, 0.0, gain.unit));
  if (std::isfinite(ratio)) {
    text += fmt::format(", {:.1f} % of it", 100.0 * ratio);
    if (std::isfinite(gain.interval.low) && std::isfinite(gain.interval.high))
      text +=
          fmt::format(" (95 %: {:.1f} to {:.1f} %)", 100.0 * gain.interval.low, 100.0 * gain.interval.high);
  }
  return text + ", on data that were not fitted";
}

std::vector<Cause> mostProbableFirst(const Tie& tie) {
  std::vector<Cause> causes = tie.causes;
  std::ranges::stable_sort(causes, std::greater<>(), &Cause::probability);
  return causes;
}

const Tie* tieOfCause(const Report& report, const Cause& cause) {
  for (const Tie& tie : report.ties)
    if (tie.causes.front().effect == cause.effect && tie.causes.front().joint == cause.joint) return &tie;
  return nullptr;
}

std::vector<Candidate> rankedCandidates(const Report& report) {
  std::vector<Candidate> candidates = report.candidates;
  std::ranges::stable_sort(candidates, ahead);
  return candidates;
}

bool isInModel(const Report& report, const Candidate& candidate) {
  const auto is_it = [&](const Cause& cause) {
    return cause.effect == candidate.effect && cause.joint == candidate.joint;
  };
  return std::ranges::any_of(report.causes, is_it) || std::ranges::any_of(report.also_measurable, is_it);
}

std::string candidatePercent(const Candidate& candidate) {
  if (!(candidate.probability > 0.0)) return "–";
  if (shownProbability(candidate) == 0.0) return "< 1";
  return fmt::format("{:.0f}", 100.0 * candidate.probability);
}

std::string rankingNote() {
  return "Trial fits are short: they choose during the search which effects are fitted to the end. The final "
         "probability comes from models that were fitted to the end and compared on held-out data. An effect "
         "that removes much in its trial is improbable in the end where another one explains the same "
         "better. "
         "–: in no model that was fitted to the end.";
}

std::string movesText(const Cause& cause) {
  constexpr double kNamed = 0.1;  // of the joint that moves most: others are not named
  const Displacements& moves = cause.moves;
  const auto one = [](const std::string& what, const Displacement& moved, const char* unit) {
    return fmt::format("{} by {} RMS (largest {})", what, shownNumber(moved.rms, 0.0, unit),
                       shownNumber(moved.largest, 0.0, unit));
  };
  double most = 0.0;
  for (const Displacement& joint : moves.joints) most = std::max(most, joint.rms);
  std::vector<std::string> parts;
  for (std::size_t j = 0; j < moves.joints.size(); ++j)
    if (moves.joints[j].rms > kNamed * most)
      parts.push_back(
          one(fmt::format("joint {}", j + 1), moves.joints[j], moves.joints[j].slides ? "m" : "rad"));
  const bool seen = cause.effect.starts_with("camera_");  // the arm itself does not move
  if (moves.tip.largest > 0.0)
    parts.push_back(one(seen ? "the tip in the cameras' view" : "the tip", moves.tip, "m"));
  return parts.empty() ? std::string("moves nothing in these recordings")
                       : fmt::format("moves {}", fmt::join(parts, ", "));
}

std::string tipText(const Report& report) {
  std::vector<std::string> parts;
  for (const Cause& cause : report.causes) {
    const Displacement& tip = cause.moves.tip;
    if (!(tip.largest > 0.0)) continue;
    parts.push_back(fmt::format("{} RMS (largest {})", shownNumber(tip.rms, 0.0, "m"),
                                shownNumber(tip.largest, 0.0, "m")));
    if (cause.effect.starts_with("camera_")) parts.back() += " in the cameras' view";
    if (report.causes.size() > 1 || !report.ties.empty())
      parts.back() +=
          fmt::format(" by {} ({})", titleOf(cause.effect), shownJoint(cause.effect, cause.joint));
  }
  return parts.empty() ? std::string() : fmt::format("Tip displacement: {}.", fmt::join(parts, "; "));
}

std::string alsoMeasurableTitle(const Report& report) {
  return fmt::format("Also measurable, below the tolerance of {} or {:.0f} % of the mean square of a channel",
                     formatTolerance(report.material), 100.0 * kMaterialShare);
}

std::string explainedText(const Report& report, std::string_view channel) {
  const auto one = std::ranges::find(report.explainable, channel, &Explainable::channel);
  if (one == report.explainable.end()) return {};
  if (!std::isfinite(one->share))
    return fmt::format("No regression on the recorded signals explains any of the residual of {}.", channel);
  return fmt::format(
      "The effects explain {:.0f} % of what the recorded signals can explain of the residual of {}.",
      100.0 * std::max(0.0, one->share), channel);
}

Table channelTable(const Report& report) {
  const bool extended = !report.causes.empty();
  Table table;
  table.title = "RMS of measured − simulated, model by model";
  table.columns = {textColumn("recording"), textColumn("channel"),
                   number("RMS nominal", "", 3, NumberStyle::kSignificant),
                   number("refitted", "", 3, NumberStyle::kSignificant)};
  table.columns.front().grouped = true;
  if (report.recordings.size() < 2) table.columns.erase(table.columns.begin());
  if (extended) table.columns.push_back(number("extended", "", 3, NumberStyle::kSignificant));
  table.columns.push_back(number("noise", "", 2, NumberStyle::kSignificant));
  table.columns.push_back(number("fit before", "%", 2, NumberStyle::kFixed));
  if (extended) {
    table.columns.push_back(number("fit after", "%", 2, NumberStyle::kFixed));
    table.columns.push_back(textColumn("RMS ratio, held out [%]"));
  }
  for (const ChannelReport& channel : report.channels) {
    const double scale = shownUnit(channel.refitted.unit).scale;
    std::vector<TableCell> row = {recordingOf(report, channel.recording), nameOf(channel.refitted),
                                  scale * channel.nominal_statistics.rms,
                                  scale * channel.refitted_statistics.rms};
    if (extended) row.emplace_back(scale * channel.extended_statistics.rms);
    row.emplace_back(channel.refitted.noise > 0.0 ? scale * channel.refitted.noise : base::kNaN);
    row.emplace_back(channel.refitted_statistics.fit);
    if (extended) {
      row.emplace_back(channel.extended_statistics.fit);
      row.emplace_back(percentages(ratioOf(channel.gain), channel.gain.interval));
    }
    if (report.recordings.size() < 2) row.erase(row.begin());
    table.rows.push_back(std::move(row));
  }
  table.note = "Noise: standard deviation of the sensor's noise. Fit: 100 (1 − ‖e‖ / ‖y − mean‖).";
  if (extended)
    table.note +=
        " RMS ratio: after / before, on segments that were not fitted, with its 95 % interval (block "
        "bootstrap).";
  return table;
}

Table rankingTable(const Report& report, std::size_t most) {
  Table table;
  table.title = "Ranking of the candidate effects";
  table.columns = {number("round", "", 0, NumberStyle::kFixed),
                   textColumn("effect"),
                   textColumn("where"),
                   number("predicted", "%", 1, NumberStyle::kFixed),
                   number("trial removes", "%", 1, NumberStyle::kFixed),
                   number("trial score", "nats", 1, NumberStyle::kFixed),
                   textColumn("final probability [%]"),
                   textColumn("in the model")};
  table.columns.front().grouped = true;
  const std::vector<Candidate> all = rankedCandidates(report);
  std::size_t in_round = 0, excluded = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    in_round = i > 0 && all[i].round == all[i - 1].round ? in_round + 1 : 0;
    if (in_round >= most) {
      ++excluded;
      continue;
    }
    const Candidate& one = all[i];
    TableCell probability(candidatePercent(one));
    probability.number = 100.0 * one.probability;
    table.rows.push_back({static_cast<double>(one.round), titleOf(one.effect),
                          shownJoint(one.effect, one.joint), 100.0 * one.screened,
                          one.refitted ? 100.0 * one.reduction : base::kNaN,
                          one.refitted ? one.score : base::kNaN, std::move(probability),
                          isInModel(report, one) ? "yes" : "no"});
  }
  table.note =
      "Predicted, and trial removes: share of the mean square of the round's residual, by the score test "
      "and by a trial fit. Trial score: gain of log likelihood. " +
      rankingNote();
  if (excluded > 0) table.note += fmt::format(" {} more effects have a smaller prediction.", excluded);
  return table;
}

Table filterTable(const Report& report) {
  Table table;
  table.title = "Errors of the Kalman filter with each model";
  table.columns = {textColumn("joint"), number("RMS nominal", "", 3, NumberStyle::kSignificant),
                   number("refitted", "", 3, NumberStyle::kSignificant),
                   number("extended", "", 3, NumberStyle::kSignificant)};
  for (const FilterGain& one : report.filter) {
    const ShownUnit unit = shownUnit(one.unit);
    table.rows.push_back({one.joint + " [" + unit.unit + "]", unit.scale * one.nominal,
                          unit.scale * one.refitted, unit.scale * one.extended});
  }
  table.note = "RMS difference between the unscented Kalman filter's joint positions and the encoders.";
  return table;
}

Table explainableTable(const Report& report) {
  Table table;
  table.title = "RMS residual on held-out data, beside regressions on the recordings' own signals";
  table.columns = {textColumn("channel"),
                   number("refitted", "", 3, NumberStyle::kSignificant),
                   number("with effects", "", 3, NumberStyle::kSignificant),
                   number("least squares", "", 3, NumberStyle::kSignificant),
                   number("Gaussian process", "", 3, NumberStyle::kSignificant),
                   number("explained", "% of the explainable", 0, NumberStyle::kFixed),
                   textColumn("the better regression")};
  for (const Explainable& one : report.explainable) {
    const ShownUnit unit = shownUnit(one.unit);
    table.rows.push_back({one.channel + " [" + unit.unit + "]", unit.scale * one.refitted,
                          unit.scale * one.named, unit.scale * one.linear, unit.scale * one.flexible,
                          100.0 * one.share, one.leans_on});
  }
  table.note =
      "Explained: reduction of the mean square by the effects, divided by the reduction by the better "
      "regression. Least squares: on at most seven "
      "measured columns.";
  return table;
}

Table posteriorTable(const Report& report, std::size_t most) {
  Table table;
  table.title = "Posterior probability of the sets of effects";
  table.columns = {textColumn("effects"), number("probability", "%", 1, NumberStyle::kFixed)};
  double others = 1.0;
  for (std::size_t k = 0; k < std::min(most, report.posterior.size()); ++k) {
    std::vector<std::string> names;
    for (const NamedEffect& one : report.posterior[k].effects)
      names.push_back(fmt::format("{} ({})", titleOf(one.effect), shownJoint(one.effect, one.joint)));
    std::string set = names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, " + "));
    if (isModel(report, report.posterior[k].effects)) set += " ← the model";
    table.rows.push_back({set, 100.0 * report.posterior[k].probability});
    others -= report.posterior[k].probability;
  }
  table.note = fmt::format(
      "Probability of exactly these effects. All other sets together: {:.1f} %. The probability of "
      "a cause is the sum over all sets that have it.",
      100.0 * std::max(0.0, others));
  return table;
}

Table lineTable(const Report& report) {
  Table table;
  table.title = "Lines in the spectrum of the residual";
  table.columns = {textColumn("channel"), number("frequency", "Hz", 2, NumberStyle::kFixed),
                   textColumn("amplitude"), number("p", "", 2, NumberStyle::kSignificant)};
  for (const SpectralLine& line : report.lines) {
    std::string unit;
    for (const ChannelReport& channel : report.channels)
      if (channel.refitted.name == line.channel) unit = channel.refitted.unit;
    table.rows.push_back(
        {line.channel, line.frequency, shownNumber(line.amplitude, 0.0, unit), line.p_value});
  }
  table.note =
      "A line is a vibration, hum or ripple that depends on no variable of the motion. p is the probability "
      "of an equally high line in noise.";
  return table;
}

Table processTable(const ResidualProcess& process) {
  Table table;
  table.title = "What the residual of " + process.channel + " depends on";
  table.columns = {textColumn("variable"), textColumn("share of the residual's variance [%]"),
                   textColumn("changes over")};
  std::size_t excluded = 0;
  for (const ProcessVariable& one : process.variables) {
    if (!table.rows.empty() && one.relevance < kWeakly) {
      ++excluded;
      continue;
    }
    const bool has_length = one.kind != VariableKind::kDirection;
    table.rows.push_back({one.name, shownNumber(one.relevance, one.sigma, ShownUnit{100.0, {}}),
                          has_length ? shownNumber(one.length, 0.0, one.unit) : std::string()});
  }
  table.note =
      fmt::format("A Gaussian process on {} points predicts {:.0f} % of the variance on held-out segments.",
                  process.points, 100.0 * process.explained);
  if (excluded > 0) table.note += fmt::format(" {} more variables hardly matter.", excluded);
  return table;
}

}  // namespace capstan::diagnosis
