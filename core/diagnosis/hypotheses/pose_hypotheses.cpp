#include "core/diagnosis/hypotheses/pose_hypotheses.h"

#include <string>

namespace capstan::diagnosis {
namespace {

using Parameters = std::vector<robot::EffectParameter>;
using Values = std::span<const double>;

constexpr HypothesisWords kMarkerOffset{
    .title = "Marker offset on the tool",
    .what =
        "The point that the cameras track is not the point of the robot's kinematics: it has a constant "
        "offset, which is fixed to the tool and rotates with it.",
    .equation = "p_c = p + R_t (x, y, z), R_t the tool's orientation",
    .source =
        "Tsai and Lenz, A new technique for fully autonomous and efficient 3D robotics hand/eye "
        "calibration, IEEE Transactions on Robotics and Automation 5 (1989)",
    .changes = "Sensor: another point of the tool is compared with the observations.",
    .signature = "The residual is constant in the tool's frame, and rotates with the wrist in frame 0.",
    .experiment = "Rotate the wrist through its range with the tip at one position.",
};

constexpr HypothesisWords kInsertionOffset{
    .title = "Offset of the insertion",
    .what =
        "The zero of the sliding joint or the length of the tool is wrong: the tip is farther from or "
        "nearer to the remote centre than the robot reports, by the same distance everywhere.",
    .equation = "p_c = p + offset p / |p|, frame 0 in the remote centre",
    .source = "Mooring, Roth and Driels, Fundamentals of manipulator calibration, Wiley 1991, chapter 2",
    .changes = "Transmission: a constant is added to the insertion.",
    .signature =
        "The residual is a constant shift along the tool's shaft, whose direction in frame 0 rotates with "
        "the shoulder joints.",
    .experiment = "Move the shoulder joints through their range at one depth of insertion.",
};

constexpr HypothesisWords kTipGap{
    .title = "Play between motors and tip",
    .what =
        "Cables are slack or stretched by friction, or gears have play: after a reversal the motors move "
        "while the tip stays, and the tip then stays half a width behind them in each direction.",
    .equation = "play: c moves only when |c − p| would exceed half_width, axis by axis of frame 0",
    .source =
        "Nordin and Gutman, Controlling mechanical systems with backlash: a survey, Automatica 38 (2002)",
    .changes = "Transmission: the tip stays where it is until the play is crossed.",
    .signature =
        "Along each axis, the residual has one level per direction of motion, with steps at reversals.",
    .experiment = "Move slowly back and forth along each axis, repeatedly along the same path.",
};

constexpr HypothesisWords kCommandDelay{
    .title = "Tip follows its command after a dead time",
    .what =
        "Transport, control cycles and buffers delay the command by a constant time. Late camera stamps "
        "look the same; a table with both kinematics and commands distinguishes the two.",
    .equation = "p(t) = p_command(t − delay)",
    .source = "Åström and Murray, Feedback systems, Princeton 2008, chapter 10",
    .changes = "Clock: the time of the command that the tip is compared with changes.",
    .signature =
        "The residual is proportional to the command's velocity, and zero once the command has stopped for "
        "longer than the delay.",
    .experiment = "Command steps with rests between.",
};

constexpr HypothesisWords kFollowingLag{
    .title = "Tip follows its command with a lag",
    .what =
        "Controller, drives and cables follow the command with a first-order lag: the faster the command, "
        "the farther the tip is behind.",
    .equation = "time_constant dp/dt = p_command − p",
    .source = "Åström and Murray, Feedback systems, Princeton 2008, chapter 5",
    .changes = "Drive: the simulated path of the tip follows the command with a lag.",
    .signature = "The residual is proportional to the command's velocity, and decays after each stop.",
    .experiment = "Command steps with rests between.",
};

const Parameters kMarkerNumbers = {{"x", "m", -0.1, 0.1, "in the tool's frame"},
                                   {"y", "m", -0.1, 0.1, "in the tool's frame"},
                                   {"z", "m", -0.1, 0.1, "in the tool's frame"}};
const Parameters kInsertionNumbers = {{"offset", "m", -0.1, 0.1, "further from the remote centre"}};
const Parameters kGapNumbers = {{"half_width_x", "m", 0.0, 0.02, "along x of frame 0"},
                                {"half_width_y", "m", 0.0, 0.02, "along y of frame 0"},
                                {"half_width_z", "m", 0.0, 0.02, "along z of frame 0"}};
const Parameters kDelayNumbers = {{"delay", "s", -kBefore, kBefore, "from command to tip"}};
const Parameters kLagNumbers = {{"time_constant", "s", 0.0, 1.0, "with which the tip follows"}};

Eigen::Vector3d vectorOf(Values v) { return {v[0], v[1], v[2]}; }

/// Pose hypothesis of an effect that robot files also have.
PoseHypothesis known(std::string_view name, double scale, void (*set)(PoseNumbers&, Values)) {
  const Hypothesis* hypothesis = hypothesisNamed(name);
  return {hypothesis->name(), &hypothesis->words, &hypothesis->facts->parameters, scale, 0.0, set};
}

}  // namespace

std::vector<PoseHypothesis> poseHypotheses(PoseReference reference, bool turns) {
  std::vector<PoseHypothesis> all = {
      known("camera_offset", 0.01, [](PoseNumbers& n, Values v) { n.camera.offset = vectorOf(v); }),
      known("camera_rotation", 0.05, [](PoseNumbers& n, Values v) { n.camera.rotation = vectorOf(v); }),
      known("camera_scale", 0.05, [](PoseNumbers& n, Values v) { n.camera.scale = v[0]; }),
      {"insertion_offset", &kInsertionOffset, &kInsertionNumbers, 0.01, 0.0,
       [](PoseNumbers& n, Values v) { n.insertion = v[0]; }},
      {"tip_gap", &kTipGap, &kGapNumbers, 0.002, 0.001,
       [](PoseNumbers& n, Values v) { n.gap = vectorOf(v); }}};
  if (turns)
    all.push_back({"marker_offset", &kMarkerOffset, &kMarkerNumbers, 0.01, 0.0,
                   [](PoseNumbers& n, Values v) { n.marker = vectorOf(v); }});
  const auto delay = [](PoseNumbers& n, Values v) { n.camera.delay = v[0]; };
  if (reference == PoseReference::kKinematics) {
    all.push_back(known("camera_latency", 0.05, delay));
  } else {
    all.push_back({"command_delay", &kCommandDelay, &kDelayNumbers, 0.05, 0.0, delay});
    all.push_back({"following_lag", &kFollowingLag, &kLagNumbers, 0.05, 0.02,
                   [](PoseNumbers& n, Values v) { n.time_constant = v[0]; }});
  }
  return all;
}

const HypothesisWords* wordsOf(std::string_view effect) {
  if (const Hypothesis* hypothesis = hypothesisNamed(effect)) return &hypothesis->words;
  for (const PoseHypothesis& one : poseHypotheses(PoseReference::kCommand, true))
    if (one.name == effect) return one.words;
  return nullptr;
}

}  // namespace capstan::diagnosis
