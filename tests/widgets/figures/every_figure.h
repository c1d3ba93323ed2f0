#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/sample_diagnosis.h"
#include "tests/widgets/figures/figure_samples.h"
#include "widgets/figures/clock_offset_figure.h"
#include "widgets/figures/confidence_figure.h"
#include "widgets/figures/learning_curve_figure.h"
#include "widgets/figures/pose_trace_figure.h"
#include "widgets/figures/reliability_figure.h"
#include "widgets/figures/residual_figure.h"
#include "widgets/figures/signature_figure.h"

/// One of every figure that can be exported, with words as long as programs write them.
namespace capstan::widgets {

/// Two runs compared: a panel for each joint and estimator.
inline HistogramData comparisonSample(int estimators) {
  HistogramData data{
      .title = "Histogram of errors, A and B",
      .note = "A: this session, simulated RAVEN-II left; B: 2026-11-02_101500 block transfer.capstan",
      .quantity = "signed error",
      .density = true};
  const Quantity all[] = {Quantity::kKinematic, Quantity::kUkf, Quantity::kCamera};
  for (int joint = 0; joint < 3; ++joint)
    for (int e = 0; e < estimators; ++e) {
      const auto seed = static_cast<unsigned>(10 * joint + e);
      data.panels.push_back({QString(kTestJoints[joint]) + ", " + nameOf(all[e]),
                             kTestUnits[joint],
                             {{{all[e], 0, "A"}, noise(19'610, 0.6, 0.25, seed)},
                              {{all[e], 1, "B"}, noise(9'805, 0.1, 0.2, 50 + seed)}},
                             joint});
    }
  return data;
}

inline BoxplotData comparisonBoxes() {
  BoxplotData data{
      .title = "Box plot of errors, A and B", .note = comparisonSample(1).note, .quantity = "signed error"};
  for (unsigned joint = 0; joint < 3; ++joint) {
    BoxplotPanel panel{.title = kTestJoints[joint], .unit = kTestUnits[joint], .x_label = "run"};
    for (const unsigned run : {0U, 1U})
      panel.groups.push_back({run == 0 ? "A" : "B",
                              {{{Quantity::kKinematic}, boxplotOf(noise(19'610, 1.0, 0.3, joint + run))},
                               {{Quantity::kCamera}, boxplotOf(noise(2'610, 0.2, 0.3, 7 + joint + run))},
                               {{Quantity::kUkf}, boxplotOf(noise(19'610, 0.1, 0.2, 20 + joint + run))}}});
    data.panels.push_back(panel);
  }
  return data;
}

inline ClockOffsetData lagSample() {
  ClockOffsetData data{.title = "Lag between the clocks", .note = "12 motions, 10,440 pairs"};
  for (int k = -10; k <= 30; ++k) {
    data.clock_offset.tried.push_back(0.01 * k);
    data.clock_offset.misfit.push_back(0.004 + 0.4 * std::pow(0.01 * k - 0.083, 2));
  }
  data.clock_offset.clock_offset = 0.0832;
  data.clock_offset.sigma = 0.0011;
  return data;
}

inline LearningCurveData curveSample() {
  LearningCurveData data{.title = "Error on 5 trajectories held out by states learned from",
                         .note = "clean test states; dashed: what the rigid offset leaves"};
  for (const double share : {0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    auto& point = data.curve.points.emplace_back();
    point.share = share;
    point.states = static_cast<std::size_t>(share * 10'240.0);
    point.errors.distance = 1e-3 * (0.5 + 0.1 / share);
    point.errors.median_distance = 0.8 * point.errors.distance;
    point.errors.angle = 0.01 + 0.002 / share;
    point.errors.median_angle = 0.8 * point.errors.angle;
  }
  data.curve.offset.distance = 4e-3;
  data.curve.offset.angle = 0.08;
  return data;
}

inline ReliabilityData reliabilitySample() {
  ReliabilityData data{.title = "Errors within the intervals stated for them", .note = "2,040 test states"};
  for (unsigned k = 0; k < 6; ++k)
    for (const double x : noise(500, 0.0, 0.8, k)) data.stated.ratio[k].push_back(std::abs(x));
  return data;
}

inline ConfidenceData confidenceSample() {
  ConfidenceData data{.title = "Confidence at z = −112 mm", .note = "at rest, in the middle orientation"};
  data.slice.low = {-0.04, -0.03};
  data.slice.high = {0.05, 0.03};
  data.slice.near = 0.005;
  data.slice.confidence = Eigen::MatrixXd::Zero(24, 32);
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 32; ++column)
      data.slice.confidence(row, column) =
          std::exp(-0.01 * (std::pow(row - 12, 2) + std::pow(column - 14, 2)));
  for (int k = 0; k < 40; ++k) data.slice.learned.emplace_back(0.01 * std::sin(k), 0.012 * std::cos(1.7 * k));
  return data;
}

inline PoseTraceData poseSample() {
  PoseTraceData data{.title = "trajectory 7", .note = "1,200 states, 12 rejected; held out of training"};
  for (int k = 0; k < 1200; ++k) {
    if (k >= 500 && k < 600) continue;  // not seen
    const double t = 0.03 * k;
    data.t.push_back(t);
    data.rejected.push_back(k % 100 == 7);
    for (std::size_t s = 0; s < 3; ++s)
      for (std::size_t d = 0; d < 6; ++d)
        data.history[s][d].push_back((d < 3 ? 30.0 : 80.0) * std::sin(0.3 * t + static_cast<double>(d)) +
                                     (s == 1 ? 2.0 : 0.0));
  }
  return data;
}

/// Two seconds without a sample.
inline ResidualData residualSample() {
  const diagnosis::Report report = testing::sampleReport();
  ResidualData data = residualData(report, report.channels[1]);
  for (ResidualTrace& trace : data.traces) {
    const auto from = [&](double t) {
      return std::lower_bound(trace.t.begin(), trace.t.end(), t) - trace.t.begin();
    };
    const auto first = from(9.0), last = from(11.0);
    for (auto* values : {&trace.t, &trace.measured, &trace.nominal, &trace.refitted, &trace.extended})
      values->erase(values->begin() + first, values->begin() + last);
  }
  return data;
}

struct EveryFigure {
  std::string name;
  std::function<std::unique_ptr<Figure>()> make;
  bool over_time = false;  ///< with occluded time in it
};

template <class F, class Data>
EveryFigure entryOf(const char* name, Data data, bool over_time = false) {
  return {name, [data = std::move(data)] { return std::make_unique<F>(data); }, over_time};
}

inline std::vector<EveryFigure> everyFigure() {
  const diagnosis::Report report = testing::sampleReport();
  return {entryOf<HistogramFigure>("histogram", histogramSample()),
          entryOf<HistogramFigure>("comparison", comparisonSample(2)),
          entryOf<HistogramFigure>("comparison_of_three", comparisonSample(3)),
          entryOf<BoxplotFigure>("boxplot", boxplotSample()),
          entryOf<BoxplotFigure>("boxplot_runs", comparisonBoxes()),
          entryOf<BoxplotFigure>("boxplot_occlusion", occlusionSample()),
          entryOf<ConvergenceFigure>("radius", radiusSample(), true),
          entryOf<ConvergenceFigure>("cables", cableSample(), true),
          entryOf<TrajectoryFigure>("trajectory", trajectorySample(), true),
          entryOf<TrajectoryFigure>("detail", trajectorySample(25.0), true),
          entryOf<ClockOffsetFigure>("lag", lagSample()),
          entryOf<LearningCurveFigure>("learning_curve", curveSample()),
          entryOf<ReliabilityFigure>("reliability", reliabilitySample()),
          entryOf<ConfidenceFigure>("confidence", confidenceSample()),
          entryOf<PoseTraceFigure>("pose_trace", poseSample(), true),
          entryOf<ResidualFigure>("residual", residualSample(), true),
          entryOf<SignatureFigure>("signature", strongestSignatures(report, report.channels[1]))};
}

}  // namespace capstan::widgets
