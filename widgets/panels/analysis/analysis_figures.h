#pragma once

#include "core/analysis/analysis.h"
#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/histogram_figure.h"

namespace capstan::widgets {

/// What the two figures of an analysis show. Histogram: a panel a joint, estimators overlaid; of two runs a
/// panel a joint and estimator, the runs overlaid. Box plot: a panel a joint, a group a run.
struct AnalysisFigures {
  HistogramData histogram;
  BoxplotData boxplot;
};

/// `b` null: one run. `joint_names`: as the robot's file has them, empty ones stay away.
AnalysisFigures analysisFigures(const analysis::Analysis& analysis, const analysis::ErrorRun& a,
                                const analysis::ErrorRun* b, const std::array<QString, 3>& joint_names);

/// The colour that stands for an estimator.
Quantity quantityOf(experiments::Estimator estimator);

}  // namespace capstan::widgets
