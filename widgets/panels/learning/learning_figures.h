#pragma once

#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/clock_offset_figure.h"
#include "widgets/figures/confidence_figure.h"
#include "widgets/figures/learning_curve_figure.h"
#include "widgets/figures/pose_trace_figure.h"
#include "widgets/figures/reliability_figure.h"
#include "widgets/panels/learning/learning_work.h"

/// What the figures of the learning panel show, on screen and on paper.
namespace capstan::widgets {

ClockOffsetData clockOffsetData(const learning::LearningStages& stages);
/// Errors of observed held-out states (where `observed`), with the offset, corrected; `clean`: of those that
/// cleaning keeps.
BoxplotData errorData(const learning::HeldOutEvaluation& evaluation, bool clean, bool observed = true);
LearningCurveData curveData(const learning::LearningCurve& curve);
/// Trajectory `which` of stages.motions; corrected where there is a evaluation.
PoseTraceData traceData(const learning::LearningStages& stages, const learning::HeldOutEvaluation* evaluation,
                        std::size_t which);
ReliabilityData reliabilityData(const learning::HeldOutEvaluation& evaluation);
ConfidenceData confidenceData(const learning::ConfidenceSlice& slice);

/// Medians "26.1 → 6.2 → 1.9": observed, with the offset, corrected: distances [mm], or angles [deg].
QString medianWords(const learning::HeldOutEvaluation& evaluation, bool clean, bool angle);
/// "position 26.1 → 6.2 → 1.9 mm, angle 93.1 → 8.4 → 2.8°", medians.
QString errorWords(const learning::HeldOutEvaluation& evaluation, bool clean);
/// "pose and velocity"
QString motionWords(learning::Motion motion);
/// "12,345"
QString countText(std::size_t count);

}  // namespace capstan::widgets
