#pragma once

#include "core/tracking/pipeline.h"
#include "core/tracking/source.h"

namespace capstan::tracking {

/// Tracking options stored with a source, or the defaults where none are stored. Throws base::InputError.
TrackingOptions trackingOptionsOf(const SourceInfo& info);

/// Pipeline for the robot, rig, marker options (the defaults where none are stored) and registration (if any)
/// of a source. Window and command line both call this function, so their numbers are the same. Throws
/// base::InputError.
TrackingPipeline makePipeline(const SourceInfo& info, const TrackingOptions& options);
TrackingPipeline makePipeline(const SourceInfo& info);

}  // namespace capstan::tracking
