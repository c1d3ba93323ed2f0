#include "core/learning/learn.h"

#include "core/base/error.h"

namespace capstan::learning {

PreparedStates prepare(const std::vector<RawMotion>& motions, const LearningOptions& options) {
  PreparedStates prepared;
  prepared.screen = screenPoses(motions);
  prepared.lag = lagBetween(prepared.screen.motions, options.towards);
  if (options.align) prepared.taken_off = prepared.lag.lag;
  prepared.states = statesOf(prepared.screen.motions, options.towards, prepared.taken_off);
  if (prepared.states.empty())
    throw base::InputError(
        {{},
         0,
         std::string(base::nameOf(options.towards)),
         {},
         "has no pose at an instant at which the camera has one",
         "Choose another stream, or look at the stamps: both must tell the same clock's time"});
  return prepared;
}

LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options,
                     base::Progress* progress) {
  if (progress) progress->report(0.0, "Pairing and aligning");
  PreparedStates prepared = prepare(motions, options);
  CleaningReport cleaning;
  if (options.clean)
    cleaning = cleanStates(prepared.states, options.cleaning);
  else
    cleaning.reason.assign(prepared.states.size(), Reason::kNone);
  const std::vector<State> states = kept(prepared.states, cleaning);
  CorrectionModel model = options.rigid ? CorrectionModel::rigid(states, options.correction)
                                        : CorrectionModel::trained(states, options.correction, progress);
  return {std::move(prepared), std::move(cleaning), std::move(model), progress && progress->cancelled()};
}

}  // namespace capstan::learning
