#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
std::vector<Hypothesis> clockHypotheses() {
  return {
      {
          .facts = &factsOf("camera_latency"),
          .place = Place::kClock,
          .words =
              {
                  .title = "Late time stamps of the cameras",
                  .what =
                      "The cameras' time stamps are late (or early) by a constant, because of exposure, "
                      "transfer or a clock of their own: the cameras show where the tip was a moment ago.",
                  .equation = "p_c(t) = p(t − delay)",
                  .source = "Furgale, Rehder and Siegwart, Unified temporal and spatial calibration for "
                            "multi-sensor systems, IROS 2013",
                  .changes =
                      "Clock: the time at which the simulated tip is compared with the observation changes.",
                  .signature =
                      "In the camera channels, the residual is proportional to the tip's velocity, and zero "
                      "at rest. The joint encoders show nothing.",
                  .experiment = "Move fast back and forth along one axis, with rests between.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.05}}};
              },
      },
  };
}

}  // namespace capstan::diagnosis::library
