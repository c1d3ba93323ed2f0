#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/simulation/simulated_source.h"
#include "core/tracking/snapshot.h"

namespace capstan::cli {

/// Distances of detected centroids from the rendered truth, both cameras [px]: against the area centroid of
/// the marker's exact outline at mid exposure.
class CentroidStudy {
 public:
  explicit CentroidStudy(const simulation::SimulatedSource& source) : source_(source) {}
  void add(const tracking::Snapshot& snapshot);

  std::string text() const;
  nlohmann::json json() const;

 private:
  const simulation::SimulatedSource& source_;
  std::vector<double> errors_;   ///< of detections that belong to the marker [px]
  std::uint64_t in_view_ = 0;    ///< pictures that show the whole marker
  std::uint64_t detected_ = 0;   ///< of these, with any detection
  std::uint64_t strangers_ = 0;  ///< of these, of something else: farther than a marker radius away
};

}  // namespace capstan::cli
