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
/// Errors on held-out states: observed (if `observed`), with the offset, corrected. `clean`: only states that
/// cleaning accepts.
BoxplotData errorData(const learning::HeldOutEvaluation& evaluation, bool clean, bool observed = true);
LearningCurveData curveData(const learning::LearningCurve& curve);
/// Trajectory `which` of stages.motions, with the corrected poses if `evaluation` is not null.
PoseTraceData traceData(const learning::LearningStages& stages, const learning::HeldOutEvaluation* evaluation,
                        std::size_t which);
ReliabilityData reliabilityData(const learning::HeldOutEvaluation& evaluation);
ConfidenceData confidenceData(const learning::ConfidenceSlice& slice);

/// Medians as "26.1 → 6.2 → 1.9": observed, with the offset, corrected; distances [mm], or angles [deg].
QString medianWords(const learning::HeldOutEvaluation& evaluation, bool clean, bool angle);
/// Medians as "position 26.1 → 6.2 → 1.9 mm, angle 93.1 → 8.4 → 2.8°".
QString errorWords(const learning::HeldOutEvaluation& evaluation, bool clean);
/// Name of the inputs of a model, for example "pose and velocity".
QString motionWords(learning::Motion motion);
/// `count` with separators, for example "12,345".
QString countText(std::size_t count);

}  // namespace capstan::widgets
