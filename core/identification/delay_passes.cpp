#include "core/identification/delay_passes.h"

#include <algorithm>
#include <cmath>

#include "core/robot/transmission.h"

namespace capstan::identification {
namespace {

/// Adds the delay of `first` to that of `second`, so that the prior holds for the total delay.
template <class Report>
void join(const Report& first, const CameraPoseOptions& prior, Report& second) {
  const double shrink = second.delay_noise / prior.delay_sigma;
  second.camera.delay += first.camera.delay * (1.0 - shrink * shrink);
  second.seconds += first.seconds;
}

template <class Report>
bool again(const Report& report, const CameraPoseOptions& prior, const base::Progress* progress) {
  return prior.delay_sigma > 0.0 && std::abs(report.camera.delay) > kOnePassDelay &&
         !(progress && progress->cancelled());
}

}  // namespace

IdentificationData withExposuresEarlier(IdentificationData data, double delay) {
  const MotorTrack& motors = data.motors;
  const robot::Transmission transmission(data.robot);
  const robot::ArmKinematics arm(data.robot);
  std::erase_if(data.cameras, [&](CameraObservation& seen) {
    seen.t -= delay;
    if (motors.t.empty() || seen.t < motors.t.front() || seen.t > motors.t.back()) return true;
    const std::size_t before = motors.at(seen.t), after = std::min(before + 1, motors.size() - 1);
    const double gap = motors.t[after] - motors.t[before];
    if (gap > kMotorGap) return true;
    const double share = gap > 0.0 ? (seen.t - motors.t[before]) / gap : 0.0;
    seen.tip_kin = arm.tip(transmission.jointFromMotor((1.0 - share) * motors.position[before] +
                                                       share * motors.position[after]));
    return false;
  });
  return data;
}

DualUkfReport identifyDualUkfInPasses(const IdentificationData& data, const ParameterSet& set,
                                      const DualUkfOptions& options, base::Progress* progress) {
  const DualUkfReport first = identifyDualUkf(data, set, options, progress);
  if (!again(first, options.camera, progress)) return first;
  DualUkfReport second =
      identifyDualUkf(withExposuresEarlier(data, first.camera.delay), set, options, progress);
  join(first, options.camera, second);
  return second;
}

BatchReport identifyBatchInPasses(const IdentificationData& data, const ParameterSet& set,
                                  const BatchOptions& options, base::Progress* progress) {
  const BatchReport first = identifyBatch(data, set, options, progress);
  if (!again(first, options.camera, progress)) return first;
  BatchOptions from = options;
  from.start = logsOf(first.estimates);
  BatchReport second = identifyBatch(withExposuresEarlier(data, first.camera.delay), set, from, progress);
  join(first, options.camera, second);
  second.iterations += first.iterations;
  second.before = first.before;
  second.residual_before = first.residual_before;
  return second;
}

}  // namespace capstan::identification
