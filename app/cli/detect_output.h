#pragma once

#include <nlohmann/json.hpp>

#include "core/vision/marker.h"

namespace capstan::cli {

/// {"u", "v", "radius", "sigma" [px], "circularity", "area" [px]} of a marker, or {"reason"} where there is
/// none.
nlohmann::json documentOf(const vision::MarkerDetection& marker);

}  // namespace capstan::cli
