#pragma once

#include "core/tracking/pipeline.h"

namespace capstan::tracking {

/// Copies the registration and the declared failures of motor encoders from `former` to the pipeline that
/// replaces it.
inline void takeOver(const tracking::TrackingPipeline& former, tracking::TrackingPipeline& next) {
  if (former.registration()) next.setRegistration(*former.registration());
  const auto& failed = former.snapshot().motor_failed;
  for (std::size_t i = 0; i < failed.size(); ++i)
    if (failed[i] == tracking::MotorFault::kDeclared) next.setMotorFailed(static_cast<int>(i), true);
}

}  // namespace capstan::tracking
