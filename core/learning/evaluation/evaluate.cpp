#include "core/learning/evaluation/evaluate.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/learning/evaluation/held_out.h"

namespace capstan::learning {
namespace {

constexpr double kTrained = 0.9;  ///< share of the time

void checkHeldOut(const HeldOutEvaluation& evaluation) {
  if (evaluation.motions_held > 0 && evaluation.motions_held < evaluation.motions) return;
  throw base::InputError({"pose tables", 0, "trajectories", fmt::format("{}", evaluation.motions),
                          "are too few to hold some out and learn from the others",
                          "Add tables with more trajectories"});
}

/// States that are within the limits found in training.
std::vector<Reason> judged(const LearningReport& learned, const std::vector<State>& states,
                           const LearningOptions& options) {
  if (options.clean) return judgedBy(learned.cleaning, states, options.cleaning);
  return judgedBy(cleanStates(learned.prepared.states, options.cleaning), states, options.cleaning);
}

/// `middle`: mean of the commanded rotations, for PoseErrors.
Evaluation evaluated(const LearningReport& learned, const std::vector<State>& states,
                     const std::vector<Eigen::Isometry3d>& corrected, const LearningOptions& options,
                     const Eigen::Quaterniond& middle) {
  Evaluation evaluation;
  for (StepErrors* errors : {&evaluation.clean, &evaluation.all})
    for (PoseErrors& step : *errors) step.middle = middle;
  const std::vector<Reason> reasons = judged(learned, states, options);
  std::vector<State> clean;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const PosePair& pair = states[k].pair;
    const std::array poses = {pair.observed, learned.model.offset() * pair.observed, corrected[k]};
    for (std::size_t s = 0; s < kCorrectionSteps; ++s) {
      evaluation.all[s].add(poses[s], pair.commanded);
      if (reasons[k] == Reason::kNone) evaluation.clean[s].add(poses[s], pair.commanded);
    }
    if (reasons[k] == Reason::kNone) clean.push_back(states[k]);
  }
  evaluation.states = states.size();
  evaluation.clean_states = clean.size();
  if (!learned.model.processes().empty()) evaluation.stated.add(learned.model, clean);
  return evaluation;
}

}  // namespace

Evaluation evaluate(const LearningReport& learned, const std::vector<State>& states,
                    const LearningOptions& options) {
  return evaluated(learned, states, learned.model.correct(states), options, middleCommandOf(states));
}

HeldOutEvaluation evaluateHeldOut(const PreparedStates& prepared, const LearningOptions& options,
                                  const HoldOut& hold_out, base::Progress* progress,
                                  const base::ProgressPart& part) {
  const std::vector<State>& states = prepared.states;
  HeldOutEvaluation evaluation;
  evaluation.held = heldOut(states, hold_out.share, hold_out.seed);
  for (std::size_t k = 0; k < states.size(); ++k)
    if (k == 0 || states[k].motion != states[k - 1].motion)
      ++evaluation.motions, evaluation.motions_held += evaluation.held[states[k].motion];
  checkHeldOut(evaluation);
  SplitStates split = splitStates(states, evaluation.held);
  LearningReport learned =
      learnPrepared({prepared.screen, prepared.clock_offset, prepared.removed, std::move(split.train), false},
                    options, progress, part.within(0.0, kTrained));
  evaluation.cancelled = learned.cancelled;
  if (evaluation.cancelled) return evaluation;
  part.report(progress, kTrained, "errors of trajectories held out");
  evaluation.corrected = learned.model.correct(states);
  std::vector<Eigen::Isometry3d> corrected;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (evaluation.held[states[k].motion]) corrected.push_back(evaluation.corrected[k]);
  evaluation.test = evaluated(learned, split.test, corrected, options, middleCommandOf(states));
  evaluation.learned = std::move(learned);
  return evaluation;
}

}  // namespace capstan::learning
