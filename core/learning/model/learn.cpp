#include "core/learning/model/learn.h"

#include <fmt/format.h>

#include <array>

#include "core/base/error.h"
#include "core/learning/model/drift_monitor.h"
#include "core/learning/poses/check_tables.h"
#include "core/learning/poses/choose_motion.h"
#include "core/learning/poses/related_streams.h"
#include "core/learning/poses/training_states.h"

namespace capstan::learning {
namespace {

void pairAt(PreparedStates& prepared, StreamKind towards) {
  prepared.states = statesOf(prepared.screen.motions, towards, prepared.removed);
  if (prepared.states.empty())
    throw base::InputError({{},
                            0,
                            std::string(base::nameOf(towards)),
                            {},
                            "has no pose at the times of the camera's poses",
                            "Choose another stream, or check the stamps: both must be of the same clock"});
}

}  // namespace

PreparedStates prepare(const std::vector<RawMotion>& motions, const LearningOptions& options,
                       base::Progress* progress, const base::ProgressPart& part) {
  PreparedStates prepared;
  const auto goOn = [&](double fraction, const char* doing) {
    part.report(progress, fraction, doing);
    prepared.cancelled = progress && progress->cancelled();
    return !prepared.cancelled;
  };
  if (!goOn(0.0, "screening")) return prepared;
  checkTables(motions, options.towards);
  prepared.screen = screenPoses(motions);
  if (!goOn(0.2, "estimating the clock offset")) return prepared;
  prepared.clock_offset = clockOffsetBetween(prepared.screen.motions, options.towards);
  if (!goOn(0.7, "pairing")) return prepared;
  if (options.align) prepared.removed = prepared.clock_offset.clock_offset;
  pairAt(prepared, options.towards);
  return prepared;
}

PreparedStates prepareAt(double clock_offset, const std::vector<RawMotion>& motions, StreamKind towards) {
  PreparedStates prepared;
  checkTables(motions, towards);
  prepared.screen = screenPoses(motions);
  prepared.clock_offset.clock_offset = prepared.removed = clock_offset;
  pairAt(prepared, towards);
  return prepared;
}

LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options,
                     base::Progress* progress) {
  constexpr double kPrepared = 0.1;  // of the time
  return learnPrepared(prepare(motions, options, progress, {0.0, kPrepared, {}}), options, progress,
                       {kPrepared, 1.0, {}});
}

LearningReport learnPrepared(PreparedStates prepared, const LearningOptions& options,
                             base::Progress* progress, const base::ProgressPart& part) {
  constexpr double kChosen = 0.15, kWeighed = 0.45;  // of the time
  if (prepared.cancelled) return {std::move(prepared), {}, {}, CorrectionModel(CorrectionParts{}), true};
  CleaningReport cleaned;
  if (options.clean)
    cleaned = cleanStates(prepared.states, options.cleaning);
  else
    cleaned.reason.assign(prepared.states.size(), Reason::kNone);
  TrainingStates training = trainingStates(prepared.states, std::move(cleaned));
  checkRelated(prepared.screen.motions, prepared.states,
               options.clean ? training.cleaning.offset : training.offset, options.towards);
  CorrectionOptions correction = options.correction;
  correction.offset = training.offset;
  if (!correction.motion && !options.rigid)
    correction.motion = chooseMotion(training.states, correction, progress, part.within(0.0, kChosen));
  if (options.clean && options.weigh && !options.rigid)
    weigh(training, prepared.states, correction, progress,
          {part.within(kChosen, kWeighed).begin, part.within(kChosen, kWeighed).end, "weighing"});
  CorrectionModel model = options.rigid ? CorrectionModel::rigid(training.states, correction)
                                        : CorrectionModel::trained(training.states, correction, progress,
                                                                   part.within(kWeighed, 1.0));
  return {std::move(prepared), std::move(training.cleaning), std::move(training.weighing), std::move(model),
          progress && progress->cancelled()};
}

LearningReport learnMore(CorrectionModel model, double clock_offset, const std::vector<RawMotion>& motions,
                         const LearningOptions& options, base::Progress* progress) {
  constexpr double kPrepared = 0.3, kJudged = 0.7;  // of the time
  if (model.processes().empty())
    throw base::InputError({{},
                            0,
                            "model",
                            {},
                            "is a rigid offset alone, to which no states can be added",
                            "Retrain on all tables"});
  if (progress) progress->report(0.0, "pairing");
  PreparedStates prepared = prepareAt(clock_offset, motions, options.towards);
  checkRelated(prepared.screen.motions, prepared.states, model.offset(), options.towards);
  CleaningReport cleaning = cleanStates(prepared.states, options.cleaning);
  const std::vector<State> counting = kept(prepared.states, cleaning);
  if (counting.size() < kFewestStates)
    throw base::InputError({{},
                            0,
                            "states",
                            fmt::format("{}", counting.size()),
                            fmt::format("are left to learn from; at least {} are needed", kFewestStates),
                            "Record longer"});
  if (progress) progress->report(kPrepared, "comparing with the model");
  if (const DriftHistory history = driftAlong(model, counting); history.driftedNow())
    throw base::InputError({{},
                            0,
                            "motions",
                            {},
                            "contradict what the model has learned: it has drifted",
                            "Retrain on motions of the robot in its present state"});
  if (progress) progress->report(kJudged, "learning more states");
  const bool cancelled = progress && progress->cancelled();
  if (!cancelled) model.add(counting);
  return {std::move(prepared), std::move(cleaning), {}, std::move(model), cancelled};
}

}  // namespace capstan::learning
