#pragma once

#include <string>

#include "core/base/yaml.h"
#include "core/tracking/pipeline.h"

namespace capstan::tracking {

/// The tracking options stored with a source (session::SourceInfo, from a room above this one); the defaults
/// where it brings none. Throws base::InputError.
template <class Info>
TrackingOptions trackingOptionsOf(const Info& info) {
  return info.tracking.empty()
             ? TrackingOptions{}
             : base::readYaml<TrackingOptions>(info.tracking, "tracking options of " + info.title);
}

/// The pipeline for a source's info: its robot, rig, marker options (defaults where it brings none) and, when
/// there is one, its registration. The window and the command line both begin here, so that their numbers are
/// the same. Throws base::InputError.
template <class Info>
TrackingPipeline makePipeline(const Info& info, const TrackingOptions& options) {
  const vision::MarkerOptions marker =
      info.marker.empty()
          ? vision::MarkerOptions{}
          : base::readYaml<vision::MarkerOptions>(info.marker, "marker options of " + info.title);
  TrackingPipeline pipeline(info.robot, info.rig, marker, options);
  if (info.base_from_camera) pipeline.setRegistration(*info.base_from_camera);
  return pipeline;
}

template <class Info>
TrackingPipeline makePipeline(const Info& info) {
  return makePipeline(info, trackingOptionsOf(info));
}

}  // namespace capstan::tracking
