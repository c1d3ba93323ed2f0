#include "app/cli/detect_output.h"

#include <string>

namespace capstan::cli {

nlohmann::json documentOf(const vision::MarkerDetection& marker) {
  if (!marker.found()) return {{"reason", std::string(base::nameOf(marker.fault))}};
  return {{"u", marker.centroid.x()}, {"v", marker.centroid.y()},          {"radius", marker.radius},
          {"sigma", marker.sigma},    {"circularity", marker.circularity}, {"area", marker.area}};
}

}  // namespace capstan::cli
