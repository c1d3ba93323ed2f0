#include "core/analysis/analysis.h"
#include "core/experiments/trial_robots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/experiments/tables.h"
#include "core/stats/quantile.h"
#include "core/stats/rms.h"
#include "core/tracking/snapshot.h"

namespace capstan::analysis {
namespace {

bool counts(bool occluded, TimeShare share) {
  return share == TimeShare::kAll || occluded == (share == TimeShare::kOccluded);
}

const Eigen::Vector3d& errorOf(const experiments::ErrorPoint& point, experiments::Estimator estimator) {
  return estimator == experiments::Estimator::kUkf          ? point.ukf
         : estimator == experiments::Estimator::kIdentified ? point.identified
                                                            : point.kinematic;
}

void requireSamples(const ErrorRun& run, const std::vector<ErrorSummary>& summaries,
                    const AnalysisOptions& options) {
  for (const ErrorSummary& summary : summaries)
    if (summary.n > 0) return;
  throw base::InputError({run.title, 0, "time", std::string(base::nameOf(options.share)),
                          "leaves no sample of the chosen estimators",
                          "Choose other estimators or all of the time"});
}

std::string measureName(Measure measure, bool absolute) {
  const std::string name(base::nameOf(measure));
  return absolute && measure != Measure::kRms ? name + " of |error|" : name;
}

std::string noteOf(const Analysis& analysis) {
  std::string note;
  for (const std::string& run : runWords(analysis)) note += (note.empty() ? "" : " ") + run + ".";
  const std::string thinned = thinningWords(analysis);
  note += thinned.empty() ? " Every sample counts."
                          : fmt::format(" RMS: every sample. Median and IQR: {}.", thinned);
  if (analysis.options.share != TimeShare::kAll)
    note += fmt::format(" Only {} time.", base::nameOf(analysis.options.share));
  if (analysis.intervals && analysis.against != Against::kNothing)
    note += fmt::format(
        " Intervals: 95 %, circular block bootstrap, {} resamples, of at most {} evenly spaced samples of a "
        "side. P: equal means, two-sided t-test of the "
        "means of blocks, paired where both sides are of the same instants, else Welch's.",
        analysis.options.resamples, kMostResampled);
  std::string paired = pairingWords(analysis);
  if (paired.empty()) return note;
  paired[0] = 'I';
  return note + " " + paired + ".";
}

}  // namespace

std::vector<int> AnalysisOptions::joints() const {
  return joint ? std::vector<int>{*joint} : std::vector<int>{0, 1, 2};
}

SelectedErrors selectedErrors(const ErrorRun& run, experiments::Estimator estimator, int joint,
                              const AnalysisOptions& options) {
  SelectedErrors selected;
  const auto add = [&](double t, const Eigen::Vector3d& error) {
    if (!error.allFinite()) return;
    const double value = experiments::forPeople(error(joint), joint);
    selected.t.push_back(t);
    selected.value.push_back(options.absolute ? std::abs(value) : value);
  };
  if (estimator == experiments::Estimator::kCamera) {
    if (counts(false, options.share))
      for (const experiments::CameraPoint& point : run.camera) add(point.t, point.error);
  } else {
    for (const experiments::ErrorPoint& point : run.errors)
      if (counts(point.occluded, options.share)) add(point.t, errorOf(point, estimator));
  }
  return selected;
}

ErrorSummary summaryOf(const std::vector<double>& values) {
  ErrorSummary summary;
  summary.n = values.size();
  if (values.empty()) return summary;
  const double shares[] = {0.25, 0.5, 0.75};
  const std::vector<double> quartiles = stats::quantiles(values, shares);
  summary.value = {stats::rms(values), quartiles[1], quartiles[2] - quartiles[0], stats::mean(values)};
  summary.counts.fill(values.size());
  return summary;
}

ErrorSummary summaryOf(const ErrorRun& run, experiments::Estimator estimator, int joint,
                       const AnalysisOptions& options) {
  ErrorSummary summary = summaryOf(selectedErrors(run, estimator, joint, options).value);
  const ErrorMoments& all = run.momentsOf(estimator, options.share);
  if (all.n == 0) return summary;
  const auto take = [&](Measure measure, double value) {
    if (!std::isfinite(value)) return;
    summary.value[static_cast<std::size_t>(measure)] = experiments::forPeople(value, joint);
    summary.counts[static_cast<std::size_t>(measure)] = all.n;
  };
  take(Measure::kRms, all.rms()(joint));
  take(Measure::kMean, all.mean(options.absolute)(joint));
  summary.n = summary.count(Measure::kRms);
  return summary;
}

Analysis analyse(const ErrorRun& a, const ErrorRun* b, const AnalysisOptions& options) {
  Analysis analysis;
  analysis.options = options;
  analysis.title_a = a.title;
  analysis.robots_a = experiments::robotWords(a.kinematic_robot, a.filter_robot);
  if (b) {
    analysis.title_b = b->title;
    analysis.robots_b = experiments::robotWords(b->kinematic_robot, b->filter_robot);
    analysis.same_motion = sameMotion(a, *b);
  }
  std::vector<ErrorSummary> of_a, of_b;
  for (const int joint : options.joints())
    for (const experiments::Estimator estimator : options.estimators) {
      AnalysisRow row{.joint = joint, .estimator = estimator};
      row.a = summaryOf(a, estimator, joint, options);
      if (b) row.b = summaryOf(*b, estimator, joint, options);
      of_a.push_back(row.a);
      of_b.push_back(row.b);
      analysis.rows.push_back(row);
    }
  requireSamples(a, of_a, options);
  if (b) requireSamples(*b, of_b, options);
  const auto& chosen = options.estimators;
  const auto has = [&](experiments::Estimator one) {
    return std::find(chosen.begin(), chosen.end(), one) != chosen.end();
  };
  analysis.against =
      b ? Against::kRun
      : !a.own_kinematics && has(experiments::Estimator::kKinematic) && has(experiments::Estimator::kUkf)
          ? Against::kKinematic
          : Against::kNothing;
  for (AnalysisRow& row : analysis.rows) {
    const bool against_kinematic =
        analysis.against == Against::kKinematic && row.estimator == experiments::Estimator::kUkf;
    if (!b && !against_kinematic) continue;
    const ErrorSummary first =
        b ? row.a : summaryOf(a, experiments::Estimator::kKinematic, row.joint, options);
    const ErrorSummary& second = b ? row.b : row.a;
    for (std::size_t i = 0; i < kMeasures.size(); ++i)
      row.difference[i].value = second.value[i] - first.value[i];
  }
  return analysis;
}

std::vector<std::string> runWords(const Analysis& analysis) {
  const auto words = [&](const char* letter, const std::string& title, const std::string& robots,
                         ErrorSummary AnalysisRow::*side) {
    std::size_t n = 0;
    for (const AnalysisRow& row : analysis.rows) n = std::max(n, (row.*side).n);
    return fmt::format("{}: {}{}{}, n = {}", letter, title, robots.empty() ? "" : ", ", robots, n);
  };
  std::vector<std::string> all = {words("A", analysis.title_a, analysis.robots_a, &AnalysisRow::a)};
  if (!analysis.title_b.empty())
    all.push_back(words("B", analysis.title_b, analysis.robots_b, &AnalysisRow::b));
  return all;
}

std::string thinningWords(const Analysis& analysis) {
  std::string words;
  for (const auto side : {&AnalysisRow::a, &AnalysisRow::b}) {
    std::size_t kept = 0, all = 0;  // samples of the estimator that has most
    for (const AnalysisRow& row : analysis.rows) {
      const ErrorSummary& summary = row.*side;
      if (summary.n <= all) continue;
      all = summary.n;
      kept = summary.count(Measure::kMedian);
    }
    if (kept >= all) continue;
    const bool two = !analysis.title_b.empty();
    words += fmt::format("{}{}{} of {} samples", words.empty() ? "distributions of " : ", ",
                         !two                      ? ""
                         : side == &AnalysisRow::a ? "A: "
                                                   : "B: ",
                         kept, all);
  }
  return words;
}

std::string pairingWords(const Analysis& analysis) {
  if (!analysis.intervals || analysis.against != Against::kRun) return {};
  for (const AnalysisRow& row : analysis.rows)
    if (row.paired && row.common < std::max(row.a.count(Measure::kMedian), row.b.count(Measure::kMedian)))
      return fmt::format("intervals and P: of the {} instants that both runs have", row.common);
  return {};
}

int decimalsOf(const Analysis& analysis) {
  constexpr int kLeast = 3, kMost = 6;
  double smallest = 1.0;
  for (const AnalysisRow& row : analysis.rows)
    for (const ErrorSummary* side : {&row.a, &row.b})
      if (side->n > 0 && side->of(Measure::kRms) > 0.0)
        smallest = std::min(smallest, side->of(Measure::kRms));
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(smallest))), kLeast, kMost);
}

std::string probabilityText(double p, double log10_p) {
  if (!std::isfinite(log10_p)) return "–";
  if (p >= 1e-3) return fmt::format("{:.3f}", p);
  if (p > 0.0) return fmt::format("{:.0e}", p);
  return fmt::format("1e{:.0f}", log10_p);
}

base::Table tableOf(const Analysis& analysis) {
  const bool two = !analysis.title_b.empty();
  const int digits = decimalsOf(analysis);
  base::Table table;
  table.title = two ? "Errors of two runs" : "Errors of " + analysis.title_a;
  table.columns = {
      {"joint", ""}, {"estimator", ""}, {"measure", ""}, {"unit", ""}, {two ? "A" : "value", "", digits}};
  if (two) table.columns.push_back({"B", "", digits});
  table.columns.push_back({two ? "n of A" : "n", "", 0});
  if (two) table.columns.push_back({"n of B", "", 0});
  const bool differences = analysis.against != Against::kNothing;
  if (differences)
    for (const char* name : {two ? "B − A" : "UKF − kinematic", "95 % from", "95 % to"})
      table.columns.push_back({name, "", digits});
  if (differences) table.columns.push_back({"P", "", 2, base::NumberStyle::kSignificant});
  for (const AnalysisRow& row : analysis.rows)
    for (const Measure measure : kMeasures) {
      std::vector<base::TableCell> cells = {
          fmt::format("q{}", row.joint + 1), std::string(base::nameOf(row.estimator)),
          measureName(measure, analysis.options.absolute),
          tracking::kJointUnits[static_cast<std::size_t>(row.joint)], row.a.of(measure)};
      if (two) cells.emplace_back(row.b.of(measure));
      cells.emplace_back(static_cast<double>(row.a.count(measure)));
      if (two) cells.emplace_back(static_cast<double>(row.b.count(measure)));
      const Difference& d = row.of(measure);
      if (differences)
        cells.insert(cells.end(),
                     {d.value, d.low, d.high, measure == Measure::kMean ? row.p : experiments::kNone});
      table.rows.push_back(std::move(cells));
    }
  table.note = noteOf(analysis);
  return table;
}

}  // namespace capstan::analysis
