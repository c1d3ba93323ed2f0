#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/live/occlusion.h"
#include "core/simulation/simulated_source.h"
#include "core/tracking/snapshot.h"

namespace capstan::cli {

/// Distances of detected centroids from the rendered truth, both cameras [px]: against the area centroid of
/// the marker's exact outline at mid exposure. Pictures taken while the cameras were blocked on schedule do
/// not count.
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
  std::vector<double> errors_;   ///< of detections that belong to the marker [px]
  std::uint64_t in_view_ = 0;    ///< pictures that show the whole marker, unblocked
  std::uint64_t detected_ = 0;   ///< of these, with any detection
  std::uint64_t strangers_ = 0;  ///< of these, of something else: farther than a marker radius away
};

}  // namespace capstan::cli
