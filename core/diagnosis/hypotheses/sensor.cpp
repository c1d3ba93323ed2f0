#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

constexpr int kTimes = 12;           // start times, equally spaced in the middle four fifths of the recording
constexpr double kTimeScale = 0.05;  // scale of the time of a slip [s]

Starts encoderSlipStarts(const JointScales& s, int) {
  Starts all;
  for (int k = 0; k < kTimes; ++k) {
    const double share = 0.1 + 0.8 * k / (kTimes - 1);
    all.push_back({{0.0, share * s.duration}, {0.01 * s.range * s.radius * s.gear / s.capstan, kTimeScale}});
  }
  return s.duration > 0.0 ? usable(std::move(all)) : Starts{};
}

}  // namespace

std::vector<Hypothesis> sensorHypotheses() {
  return {
      {
          .facts = &factsOf("encoder_slip"),
          .place = Place::kSensor,
          .words =
              {
                  .title = "Motor encoder that has slipped",
                  .what =
                      "At one time the motor encoder lost counts, or its disc or the capstan slipped on the "
                      "shaft: from then on the reading is too small by a constant.",
                  .equation = "reading = q_m − slip u(t − time), u a smooth step",
                  .source = "Hinkley, Inference about the change-point in a sequence of random variables, "
                            "Biometrika 57 (1970): a step of unknown size at an unknown time",
                  .changes = "Sensor: from `time` on the motor position is its reading plus slip.",
                  .signature =
                      "Against time, the residual is a step: one constant before it and another one after "
                      "it, whatever the arm does.",
                  .experiment =
                      "Return to the same pose again and again, with fast motion in between; the hard stop "
                      "is the best pose for this.",
              },
          .neutral = {0.0, 0.0},
          .grid = encoderSlipStarts,
      },
      {
          .facts = &factsOf("camera_rotation"),
          .place = Place::kSensor,
          .words =
              {
                  .title = "Cameras registered with a rotation",
                  .what =
                      "The registration of the cameras to the robot is rotated, because of a bumped tripod "
                      "or a poor calibration: all observations are rotated about the origin of frame 0.",
                  .equation = "p_c = R p, R the rotation by the vector (x, y, z) in frame 0",
                  .source =
                      "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
                      "of the Optical Society of America A 4 (1987)",
                  .changes = "Sensor: observations are rotated about the origin of frame 0.",
                  .signature =
                      "In the camera channels, the residual is a straight line against the tip's other "
                      "coordinates, and zero at the origin of frame 0. It does not depend on direction or "
                      "speed. The joint encoders show nothing.",
                  .experiment = "Take poses over the whole workspace, also far from the origin of frame 0.",
              },
          .neutral = {0.0, 0.0, 0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0, 0.0, 0.0}, {0.03, 0.03, 0.03}}};
              },
          .size = [](const std::vector<double>& v) { return amplitude(v, 3); },
      },
      {
          .facts = &factsOf("camera_offset"),
          .place = Place::kSensor,
          .words =
              {
                  .title = "Cameras registered with an offset",
                  .what =
                      "The registration of the cameras to the robot is shifted, or the marker is at another "
                      "position on the tool than in the robot file.",
                  .equation = "p_c = p + (x, y, z) in frame 0",
                  .source =
                      "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
                      "of the Optical Society of America A 4 (1987)",
                  .changes = "Sensor: a constant is added to the observations.",
                  .signature =
                      "The residual of each camera channel is constant, whatever the arm does. The joint "
                      "encoders show nothing.",
                  .experiment =
                      "Take poses over the workspace that rotate the tool: the shift of a marker rotates "
                      "with the tool, the shift of a camera does not.",
              },
          .neutral = {0.0, 0.0, 0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0, 0.0, 0.0}, {0.005, 0.005, 0.005}}};
              },
          .size = [](const std::vector<double>& v) { return amplitude(v, 3); },
      },
      {
          .facts = &factsOf("camera_scale"),
          .place = Place::kSensor,
          .words =
              {
                  .title = "Cameras with a wrong scale",
                  .what =
                      "The baseline of the stereo cameras or the size of their calibration target is wrong: "
                      "all observations are scaled about the origin of frame 0.",
                  .equation = "p_c = (1 + share) p in frame 0",
                  .source =
                      "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
                      "of the Optical Society of America A 4 (1987)",
                  .changes = "Sensor: observations are multiplied by 1 + share.",
                  .signature =
                      "In the camera channels, the residual is a straight line against the tip's own "
                      "coordinate, with the same slope in all three. The joint encoders show nothing.",
                  .experiment = "Take poses near to and far from the origin of frame 0, in all directions.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.03}}};
              },
      },
      {
          .facts = &factsOf("sensor_sign"),
          .place = Place::kSensor,
          .words =
              {
                  .title = "Load sensor without a sign",
                  .what =
                      "The sensor of the external load measures only the magnitude of the load and not its "
                      "sign, like a rectifying amplifier or a cable-force sensor.",
                  .equation = "reading = |τ_ext|",
                  .source = "Horowitz and Hill, The Art of Electronics (1989): the full-wave rectifier, or "
                            "absolute-value circuit",
                  .changes = "Sensor: the measured load is used with a sign that is reconstructed from the "
                             "recording.",
                  .signature =
                      "Against the measured load, the residual has two mirrored branches: zero while the "
                      "load is positive, twice the load's effect while it is negative.",
                  .experiment = "Push the joint at rest by hand to one side, then to the other.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{1.0}, {0.0}}, {{-1.0}, {0.0}}};
              },
      },
  };
}

}  // namespace capstan::diagnosis::library
