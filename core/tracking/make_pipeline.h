#pragma once

#include "core/tracking/pipeline.h"
#include "core/tracking/source.h"

namespace capstan::tracking {

/// The tracking options stored with a source; the defaults where it brings none. Throws base::InputError.
TrackingOptions trackingOptionsOf(const SourceInfo& info);

/// The pipeline for a source's info: its robot, rig, marker options (defaults where it brings none) and, when
/// there is one, its registration. The window and the command line both begin here, so that their numbers are
/// the same. Throws base::InputError.
TrackingPipeline makePipeline(const SourceInfo& info, const TrackingOptions& options);
TrackingPipeline makePipeline(const SourceInfo& info);

}  // namespace capstan::tracking
