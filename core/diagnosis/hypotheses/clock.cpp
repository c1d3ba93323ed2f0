#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
std::vector<Hypothesis> clockHypotheses() {
  return {
      {
          .facts = &factsOf("camera_latency"),
          .place = Place::kClock,
          .words =
              {
                  .title = "Cameras late by their stamps",
                  .what =
                      "Exposure, transfer and a clock of their own make the cameras' time stamps late (or "
                      "early) by a constant: they show where the tip was a moment ago.",
                  .equation = "p_c(t) = p(t − delay)",
                  .source = "Furgale, Rehder and Siegwart, Unified temporal and spatial calibration for "
                            "multi-sensor systems, IROS 2013",
                  .changes = "Clock: the instant at which the tip is compared with what the cameras saw.",
                  .signature =
                      "In proportion to the tip's velocity in the cameras' channels, nothing at rest and "
                      "nothing in the joint encoders.",
                  .experiment = "Fast motion back and forth along one axis; rests between.",
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
