#pragma once

#include <opencv2/core/types.hpp>

#include "app/monitor/banner.h"
#include "app/monitor/layout.h"
#include "app/monitor/sketch.h"

namespace capstan::monitor {

/// Draws over one eye's image, which fills `rect`: the detected circle, and where the filter has them, arm
/// and tip. With the cameras they are solid; without them they are dashed, in the banner's colour, with the 2
/// sigma ellipse of the tip. `image`: size of the camera's image [px].
void sketchEye(Sketch& sketch, const live::FeedEye& eye, const Banner& banner, const Rect& rect,
               const cv::Size& image);

}  // namespace capstan::monitor
