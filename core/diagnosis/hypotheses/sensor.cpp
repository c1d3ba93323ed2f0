#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

constexpr int kTimes = 12;           // equally far apart in the middle four fifths of the recording
constexpr double kTimeScale = 0.05;  // [s]

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
                      "At one instant the motor encoder lost counts, or its disc or the capstan slipped on "
                      "the shaft: from then on the reading falls short of the motor by a constant.",
                  .equation = "reading = q_m − slip u(t − time), u a smooth step",
                  .source = "Hinkley, Inference about the change-point in a sequence of random variables, "
                            "Biometrika 57 (1970): a step of unknown size at an unknown time",
                  .changes =
                      "Sensor: from `time` on the motor stands further than its reading says, by slip.",
                  .signature =
                      "A step against time: one constant before it and another one after it, whatever the "
                      "arm does.",
                  .experiment =
                      "Go back to the same pose again and again, with fast motion in between; the hard "
                      "stop is the best of poses.",
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
                      "The registration of the cameras to the robot is turned, by a bumped tripod or a poor "
                      "calibration: everything they see is turned about the origin of frame 0.",
                  .equation = "p_c = R p, R the rotation by the vector (x, y, z) in frame 0",
                  .source =
                      "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
                      "of the Optical Society of America A 4 (1987)",
                  .changes = "Sensor: what the cameras see is turned about the origin of frame 0.",
                  .signature =
                      "In the cameras' channels straight lines against the tip's other coordinates, zero at "
                      "the origin of frame 0; nothing in the joint encoders, and none of it depends on "
                      "direction or speed.",
                  .experiment = "Poses spread over the whole workspace, also far from the origin of frame 0.",
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
                  .what = "The registration of the cameras to the robot is shifted, or the marker sits "
                          "elsewhere on the tool than the robot file says.",
                  .equation = "p_c = p + (x, y, z) in frame 0",
                  .source =
                      "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
                      "of the Optical Society of America A 4 (1987)",
                  .changes = "Sensor: a constant is added to what the cameras see.",
                  .signature =
                      "A constant in each of the cameras' channels, whatever the arm does; nothing in the "
                      "joint encoders.",
                  .experiment =
                      "Poses spread over the workspace that turn the tool: a shift of the marker turns with "
                      "it, one of the cameras does not.",
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
                      "The base line of the stereo cameras or the size of their calibration target is "
                      "wrong: all that they see is larger or smaller, as seen from the origin of frame 0.",
                  .equation = "p_c = (1 + share) p in frame 0",
                  .source =
                      "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
                      "of the Optical Society of America A 4 (1987)",
                  .changes = "Sensor: what the cameras see is multiplied by 1 + share.",
                  .signature =
                      "In the cameras' channels a straight line against the tip's own coordinate, of one "
                      "slope in all three; nothing in the joint encoders.",
                  .experiment = "Poses near to and far from the origin of frame 0, in all directions.",
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
                      "The sensor of the external load measures only how large it is, not to which side it "
                      "pushes, as a rectifying amplifier or a cable-force sensor does.",
                  .equation = "reading = |τ_ext|",
                  .source = "Horowitz and Hill, The Art of Electronics (1989): the full-wave rectifier, or "
                            "absolute-value circuit",
                  .changes =
                      "Sensor: the measured load enters with its magnitude, and with a sign that is taken "
                      "from the recording instead.",
                  .signature =
                      "Against the measured load two branches, mirrored: no residual while the load pushes "
                      "forwards, twice the load's effect while it pushes backwards.",
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
