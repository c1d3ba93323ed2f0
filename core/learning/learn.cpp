#include "core/learning/learn.h"

#include <fmt/format.h>

#include <array>

#include "core/base/error.h"
#include "core/learning/drift_monitor.h"
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

/// A stream of poses that are further apart than a motion is long has stamps in another unit.
void checkStamps(const ScreenReport& screen, StreamKind stream) {
  constexpr double kLongest = 2.0;  // [s]
  std::vector<double> steps;
  for (const PoseMotion& motion : screen.motions)
    for (std::size_t k = 1; k < motion.of(stream).size(); ++k)
      steps.push_back(motion.of(stream)[k].t - motion.of(stream)[k - 1].t);
  const double step = steps.empty() ? 0.0 : stats::median(std::move(steps));
  if (step <= kLongest) return;
  throw base::InputError({{},
                          0,
                          fmt::format("stamps of the {}", base::nameOf(stream)),
                          fmt::format("{:.3g} s", step),
                          "lie between half of its poses, too long to follow a motion",
                          "Give stamps in seconds"});
}

void checkStream(const ScreenReport& screen, StreamKind stream) {
  checkPoses(screen, stream);
  checkStamps(screen, stream);
}

/// How wide nine tenths of a stream's positions lie along each of its axes [m].
Eigen::Vector3d widthsOf(const std::vector<State>& states, Eigen::Isometry3d PosePair::*pose) {
  constexpr std::array kTails = {0.05, 0.95};
  Eigen::Vector3d widths;
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::vector<double> along;
    for (const State& state : states) along.push_back((state.pair.*pose).translation()[i]);
    const std::vector<double> ends = stats::quantiles(along, kTails);
    widths[i] = ends[1] - ends[0];
  }
  return widths;
}

/// What makes two streams differ so: an axis far wider than all of the other's is in another unit.
std::string unitsAdvice(const std::vector<State>& states, StreamKind towards) {
  constexpr double kOtherUnit = 20.0;
  const Eigen::Vector3d seen = widthsOf(states, &PosePair::seen), told = widthsOf(states, &PosePair::told);
  const bool is_seen = seen.maxCoeff() > told.maxCoeff();
  const Eigen::Vector3d& wide = is_seen ? seen : told;
  const double narrow = (is_seen ? told : seen).maxCoeff();
  std::string axes;
  for (Eigen::Index i = 0; i < 3; ++i)
    if (wide[i] > kOtherUnit * narrow) axes += fmt::format("{}{}", axes.empty() ? "" : ", ", "xyz"[i]);
  if (axes.empty()) return "Check units (metres), the order of axes and of quaternions (x, y, z, w)";
  const StreamKind wider = is_seen ? StreamKind::kCamera : towards,
                   other = is_seen ? towards : StreamKind::kCamera;
  return fmt::format("Give {} of the {} in metres: it is up to {:.3g} m wide, all of the {} {:.2g} m", axes,
                     base::nameOf(wider), wide.maxCoeff(), base::nameOf(other), narrow);
}

/// Half of the states must be nearer to what was told, the offset taken off, than the motions are long: else
/// no offset relates the two streams, and nothing can be learned of what it leaves.
void checkRelated(const std::vector<State>& states, const Eigen::Isometry3d& offset, StreamKind towards) {
  constexpr double kMost = 0.6;
  std::vector<double> off, way;
  std::array<std::vector<double>, 3> told;
  for (const State& state : states)
    for (std::size_t i = 0; i < 3; ++i)
      told[i].push_back(state.pair.told.translation()[static_cast<Eigen::Index>(i)]);
  const Eigen::Vector3d middle(stats::median(told[0]), stats::median(told[1]), stats::median(told[2]));
  for (const State& state : states) {
    off.push_back((offset * state.pair.seen.translation() - state.pair.told.translation()).norm());
    way.push_back((state.pair.told.translation() - middle).norm());
  }
  const double left = stats::median(off), size = stats::median(way);
  if (left <= kMost * size) return;
  throw base::InputError(
      {{},
       0,
       "poses",
       fmt::format("{:.3g} m", left),
       fmt::format("is what the best rigid offset leaves of half of the sights, and motions are "
                   "{:.3g} m long",
                   size),
       unitsAdvice(states, towards) + "; both streams must be of one arm"});
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
  checkStream(prepared.screen, StreamKind::kCamera);
  checkStream(prepared.screen, options.towards);
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
  checkStream(prepared.screen, StreamKind::kCamera);
  checkStream(prepared.screen, towards);
  prepared.lag.lag = prepared.taken_off = lag;
  pairAt(prepared, towards);
  return prepared;
}

LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options,
                     base::Progress* progress) {
  constexpr double kPrepared = 0.1, kCleaned = 0.4;  // of the time
  PreparedStates prepared = prepare(motions, options, progress, {0.0, kPrepared, {}});
  if (prepared.cancelled) return {std::move(prepared), {}, {}, CorrectionModel(CorrectionParts{}), true};
  CleaningReport cleaned;
  if (options.clean)
    cleaned = cleanStates(prepared.states, options.cleaning);
  else
    cleaned.reason.assign(prepared.states.size(), Reason::kNone);
  TrainingStates training = trainingStates(prepared.states, std::move(cleaned), options.correction.lever);
  checkRelated(prepared.states, options.clean ? training.cleaning.offset : training.offset, options.towards);
  if (options.clean && options.weigh && !options.rigid)
    weigh(training, prepared.states, options.cleaning, options.correction, progress,
          {kPrepared, kCleaned, "weighing"});
  CorrectionOptions correction = options.correction;
  correction.offset = training.offset;
  CorrectionModel model =
      options.rigid ? CorrectionModel::rigid(training.states, correction)
                    : CorrectionModel::trained(training.states, correction, progress, {kCleaned, 1.0, {}});
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
  CleaningReport cleaning = cleanStates(prepared.states, options.cleaning);
  const std::vector<State> counting = kept(prepared.states, cleaning);
  if (counting.size() < kFewestStates)
    throw base::InputError({{},
                            0,
                            "states",
                            fmt::format("{}", counting.size()),
                            fmt::format("are left to learn from; {} at least", kFewestStates),
                            "Check units (metres) and the order of axes and quaternions, or record longer"});
  checkRelated(counting, model.offset(), options.towards);
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
