#pragma once

#include "core/analysis/analysis.h"
#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/histogram_figure.h"

namespace capstan::widgets {

/// Data of the two figures of an analysis. Histogram: one panel per joint with the estimators overlaid; for
/// two runs one panel per joint and estimator with the runs overlaid. Box plot: one panel per joint, one
/// group per run.
struct AnalysisFigures {
  HistogramData histogram;
  BoxplotData boxplot;
};

/// Data for runs `a` and `b`; `b` null: one run. `joint_names`: as in the robot file; empty names are not
/// shown.
AnalysisFigures analysisFigures(const analysis::Analysis& analysis, const analysis::ErrorRun& a,
                                const analysis::ErrorRun* b, const std::array<QString, 3>& joint_names);

/// The quantity whose colour an estimator has.
Quantity quantityOf(experiments::Estimator estimator);

}  // namespace capstan::widgets
