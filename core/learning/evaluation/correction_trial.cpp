#include "core/learning/evaluation/correction_trial.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/learning/evaluation/held_out.h"
#include "core/learning/poses/choose_motion.h"
#include "core/learning/poses/training_states.h"

namespace capstan::learning {
namespace {

using learning::Reason;
using learning::State;

constexpr double kChosen = 0.15, kWeighed = 0.4, kTraining = 0.9;  ///< of the time

void checkHeldOut(const CorrectionTrial& trial) {
  if (trial.motions_held > 0 && trial.motions_held < trial.motions) return;
  throw base::InputError({"pose tables", 0, "trajectories", fmt::format("{}", trial.motions),
                          "are too few to hold some out and to learn from others",
                          "Add tables with more trajectories"});
}

void addErrors(CorrectionTrial& trial, const State& state, const Eigen::Isometry3d& corrected, bool clean) {
  const std::array poses = {state.pair.seen, trial.model->offset() * state.pair.seen, corrected};
  for (std::size_t s = 0; s < kCorrectionSteps; ++s) {
    trial.dirty[s].add(poses[s], state.pair.told);
    if (clean) trial.clean[s].add(poses[s], state.pair.told);
  }
}

}  // namespace

CorrectionTrial correctionTrial(const std::vector<State>& states, const CorrectionTrialOptions& options,
                                base::Progress* progress) {
  CorrectionTrial trial;
  trial.held = heldOut(states, options.test_share, options.seed);
  for (std::size_t k = 0; k < states.size(); ++k)
    if (k == 0 || states[k].motion != states[k - 1].motion)
      ++trial.motions, trial.motions_held += trial.held[states[k].motion];
  checkHeldOut(trial);
  if (progress) progress->report(0.0, "cleaning");
  const auto [train, test] = splitStates(states, trial.held);
  const learning::CleaningReport cleaned = learning::cleanStates(train, options.cleaning);
  const std::vector<Reason> reasons = learning::judgedBy(cleaned, test, options.cleaning);
  learning::TrainingStates training = learning::trainingStates(train, cleaned, options.correction.lever);
  learning::CorrectionOptions correction = options.correction;
  correction.offset = training.offset;
  if (!correction.motion)
    correction.motion = learning::chooseMotion(training.states, correction, progress, {0.0, kChosen, {}});
  if (options.weigh)
    learning::weigh(training, train, options.cleaning, correction, progress, {kChosen, kWeighed, "weighing"});
  trial.learned = std::move(training.states);
  trial.weighing = std::move(training.weighing);
  trial.model =
      learning::CorrectionModel::trained(trial.learned, correction, progress, {kWeighed, kTraining, {}});
  if (progress && progress->cancelled()) {
    trial.model.reset();
    trial.cancelled = true;
    return trial;
  }
  if (progress) progress->report(kTraining, "errors of trajectories held out");
  for (StepErrors* errors : {&trial.clean, &trial.dirty})
    for (PoseErrors& step : *errors) step.middle = middleToldOf(states);
  trial.corrected = trial.model->correct(states);
  std::vector<State> clean;
  for (std::size_t k = 0, t = 0; k < states.size(); ++k) {
    if (!trial.held[states[k].motion]) continue;
    const bool counts = reasons[t++] == Reason::kNone;
    addErrors(trial, states[k], trial.corrected[k], counts);
    if (counts) clean.push_back(states[k]);
  }
  trial.stated.add(*trial.model, clean);
  trial.model->add(clean);
  return trial;
}

}  // namespace capstan::learning
