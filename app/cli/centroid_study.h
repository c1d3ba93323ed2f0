#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/live/occlusion.h"
#include "core/simulation/simulated_source.h"
#include "core/tracking/snapshot.h"

namespace capstan::cli {

/// Errors of detected marker centroids in the images of both simulated cameras [px]. The truth is the area
/// centroid of the marker's exact outline at mid exposure. Images that were taken while the schedule blocked
/// the cameras do not count.
class CentroidStudy {
 public:
  CentroidStudy(const simulation::SimulatedSource& source, const live::OcclusionSchedule& occlusion)
      : source_(source), occlusion_(occlusion) {}
  void add(const tracking::Snapshot& snapshot);

  std::string text() const;
  nlohmann::json json() const;

 private:
  bool blockedAt(double exposed) const;

  const simulation::SimulatedSource& source_;
  const live::OcclusionSchedule occlusion_;
  std::vector<double> errors_;   ///< errors of detections of the marker [px]
  std::uint64_t in_view_ = 0;    ///< unblocked images that show the whole marker
  std::uint64_t detected_ = 0;   ///< images in view with a detection
  std::uint64_t strangers_ = 0;  ///< detections of other objects: error above a marker radius
};

}  // namespace capstan::cli
