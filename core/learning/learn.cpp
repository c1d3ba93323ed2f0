#include "core/learning/learn.h"

#include <fmt/format.h>

#include <array>

#include "core/base/error.h"
#include "core/learning/choose_motion.h"
#include "core/learning/drift_monitor.h"
#include "core/learning/related_streams.h"
#include "core/learning/training_states.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

void checkPoses(const ScreenReport& screen, StreamKind stream) {
  const auto at = static_cast<std::size_t>(stream);
  if (screen.poses[at] > 0) return;
  std::string reasons;
  for (const auto& [reason, name] : base::NamesOf<Reason>::value)
    if (const std::size_t n = screen.count(stream, reason); n > 0) reasons += fmt::format(", {} {}", n, name);
  throw base::InputError({{},
                          0,
                          std::string(base::nameOf(stream)),
                          {},
                          screen.rows[at] == 0
                              ? "these tables have no such poses"
                              : fmt::format("has no pose in {} rows{}", screen.rows[at], reasons),
                          "Give tables with this stream, quaternions of norm 1 as x, y, z, w"});
}

/// Sights are paired with what is told near them, in kLongestGap: poses told seconds apart have stamps in
/// another unit.
void checkStamps(const ScreenReport& screen, StreamKind told) {
  constexpr double kLongest = 2.0;  // [s]
  std::vector<double> steps;
  for (const PoseMotion& motion : screen.motions)
    for (std::size_t k = 1; k < motion.of(told).size(); ++k)
      steps.push_back(motion.of(told)[k].t - motion.of(told)[k - 1].t);
  const double step = steps.empty() ? 0.0 : stats::median(std::move(steps));
  if (step <= kLongest) return;
  throw base::InputError({{},
                          0,
                          fmt::format("stamps of the {}", base::nameOf(told)),
                          fmt::format("{:.3g} s", step),
                          "is the median step from one pose to the next, too long to follow a motion",
                          "Give stamps in seconds, and poses at 10 Hz at least"});
}

void checkStreams(const ScreenReport& screen, StreamKind told) {
  checkPoses(screen, StreamKind::kCamera);
  checkPoses(screen, told);
  checkStamps(screen, told);
}

void pairAt(PreparedStates& prepared, StreamKind towards) {
  prepared.states = statesOf(prepared.screen.motions, towards, prepared.taken_off);
  if (prepared.states.empty())
    throw base::InputError(
        {{},
         0,
         std::string(base::nameOf(towards)),
         {},
         "has no pose at an instant at which the camera has one",
         "Choose another stream, or look at the stamps: both must tell the same clock's time"});
}

}  // namespace

void checkTable(const std::vector<RawMotion>& motions, StreamKind towards) {
  checkStreams(screenPoses(motions), towards);
}

PreparedStates prepare(const std::vector<RawMotion>& motions, const LearningOptions& options,
                       base::Progress* progress, const base::ProgressPart& part) {
  PreparedStates prepared;
  const auto goOn = [&](double fraction, const char* doing) {
    part.report(progress, fraction, doing);
    prepared.cancelled = progress && progress->cancelled();
    return !prepared.cancelled;
  };
  if (!goOn(0.0, "screening")) return prepared;
  prepared.screen = screenPoses(motions);
  checkStreams(prepared.screen, options.towards);
  if (!goOn(0.2, "looking for the lag")) return prepared;
  prepared.lag = lagBetween(prepared.screen.motions, options.towards, options.lag);
  if (!goOn(0.7, "pairing")) return prepared;
  if (options.align) prepared.taken_off = prepared.lag.lag;
  pairAt(prepared, options.towards);
  return prepared;
}

PreparedStates prepareAt(double lag, const std::vector<RawMotion>& motions, StreamKind towards) {
  PreparedStates prepared;
  prepared.screen = screenPoses(motions);
  checkStreams(prepared.screen, towards);
  prepared.lag.lag = prepared.taken_off = lag;
  pairAt(prepared, towards);
  return prepared;
}

LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options,
                     base::Progress* progress) {
  constexpr double kPrepared = 0.1, kChosen = 0.25, kWeighed = 0.5;  // of the time
  PreparedStates prepared = prepare(motions, options, progress, {0.0, kPrepared, {}});
  if (prepared.cancelled) return {std::move(prepared), {}, {}, CorrectionModel(CorrectionParts{}), true};
  CleaningReport cleaned;
  if (options.clean)
    cleaned = cleanStates(prepared.states, options.cleaning);
  else
    cleaned.reason.assign(prepared.states.size(), Reason::kNone);
  TrainingStates training = trainingStates(prepared.states, std::move(cleaned), options.correction.lever);
  checkRelated(prepared.states, options.clean ? training.cleaning.offset : training.offset, options.towards);
  CorrectionOptions correction = options.correction;
  correction.offset = training.offset;
  if (!correction.motion && !options.rigid)
    correction.motion = chooseMotion(training.states, correction, progress, {kPrepared, kChosen, {}});
  if (options.clean && options.weigh && !options.rigid)
    weigh(training, prepared.states, options.cleaning, correction, progress, {kChosen, kWeighed, "weighing"});
  CorrectionModel model =
      options.rigid ? CorrectionModel::rigid(training.states, correction)
                    : CorrectionModel::trained(training.states, correction, progress, {kWeighed, 1.0, {}});
  return {std::move(prepared), std::move(training.cleaning), std::move(training.weighing), std::move(model),
          progress && progress->cancelled()};
}

LearningReport learnMore(CorrectionModel model, double lag, const std::vector<RawMotion>& motions,
                         const LearningOptions& options, base::Progress* progress) {
  constexpr double kPrepared = 0.3, kJudged = 0.7;  // of the time
  if (model.processes().empty())
    throw base::InputError({{},
                            0,
                            "model",
                            {},
                            "is a rigid offset alone, which takes nothing in",
                            "Learn anew from all tables"});
  if (progress) progress->report(0.0, "pairing");
  PreparedStates prepared = prepareAt(lag, motions, options.towards);
  checkRelated(prepared.states, model.offset(), options.towards);
  CleaningReport cleaning = cleanStates(prepared.states, options.cleaning);
  const std::vector<State> counting = kept(prepared.states, cleaning);
  if (counting.size() < kFewestStates)
    throw base::InputError({{},
                            0,
                            "states",
                            fmt::format("{}", counting.size()),
                            fmt::format("are left to learn from; {} at least", kFewestStates),
                            "Record longer"});
  if (progress) progress->report(kPrepared, "comparing with what is known");
  if (const DriftCourse course = driftAlong(model, counting); course.agedNow())
    throw base::InputError({{},
                            0,
                            "motions",
                            {},
                            "contradict what the model has learned: it has aged",
                            "Learn anew from motions that are as the robot is now"});
  if (progress) progress->report(kJudged, "learning more states");
  const bool cancelled = progress && progress->cancelled();
  if (!cancelled) model.add(counting);
  return {std::move(prepared), std::move(cleaning), {}, std::move(model), cancelled};
}

}  // namespace capstan::learning
