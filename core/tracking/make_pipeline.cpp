#include "core/tracking/make_pipeline.h"

#include "core/base/yaml.h"

namespace capstan::tracking {

TrackingOptions trackingOptionsOf(const SourceInfo& info) {
  return info.tracking.empty()
             ? TrackingOptions{}
             : base::readYaml<TrackingOptions>(info.tracking, "tracking options of " + info.title);
}

TrackingPipeline makePipeline(const SourceInfo& info, const TrackingOptions& options) {
  const vision::MarkerOptions marker =
      info.marker.empty()
          ? vision::MarkerOptions{}
          : base::readYaml<vision::MarkerOptions>(info.marker, "marker options of " + info.title);
  TrackingPipeline pipeline(info.robot, info.rig, marker, options);
  if (info.base_from_camera) pipeline.setRegistration(*info.base_from_camera);
  pipeline.setOwnKinematics(info.own_kinematics);
  return pipeline;
}

TrackingPipeline makePipeline(const SourceInfo& info) { return makePipeline(info, trackingOptionsOf(info)); }

}  // namespace capstan::tracking
