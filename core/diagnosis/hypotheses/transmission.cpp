#include <algorithm>
#include <limits>

#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

/// One start per other joint; a fit does not change the other joint.
Starts cableCouplingStarts(const JointScales& s, int joint) {
  Starts all;
  for (int other = 1; other <= s.joints; ++other)
    if (other != joint) all.push_back({{0.0, static_cast<double>(other)}, {0.05, 0.0}});
  return usable(std::move(all));
}

constexpr double kDriftsOn = 1.0;  // least time constant [s]: what settles sooner is an error of the zero

/// Starts with several time constants: a drift that settles early and one that lasts to the end of the
/// recording look different.
Starts zeroDriftStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.05, 0.15, 0.4}) {
    const double time = std::max(share * s.duration, kDriftsOn);
    all.push_back({{0.0, time}, {0.02 * s.range, 0.5 * time}});
  }
  return s.duration > 0.0 ? usable(std::move(all)) : Starts{};
}

}  // namespace

std::vector<Hypothesis> transmissionHypotheses() {
  return {
      {
          .facts = &factsOf("pulley_radius"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Pulley of another radius",
                  .what = "The pulley at the joint is larger or smaller than in the robot file, because of a "
                          "worn groove, another cable diameter or a wrong drawing: a revolution of the motor "
                          "moves the joint less or more.",
                  .equation =
                      "s_l = r_l (1 + share) (A (q − q_hs)), hence q − q_hs is the nominal one / (1 + "
                      "share)",
                  .source =
                      "Haghighipanah, Miyasaka, Li and Hannaford, Unscented Kalman filter and 3D vision to "
                      "improve cable driven surgical robot joint angle estimation, ICRA 2016, (3) and (4): "
                      "r_l is its most uncertain number",
                  .changes = "Transmission: the link radius r_l of this joint is multiplied by 1 + share.",
                  .signature =
                      "Against the joint's own position, the residual is a straight line that is zero at "
                      "the hard stop, the same in both directions of motion and at every speed.",
                  .experiment =
                      "Sweep slowly over the whole range without load; the range matters, the speed does "
                      "not.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.05}}};
              },
      },
      {
          .facts = &factsOf("cable_coupling"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Cable coupling to another joint's motion",
                  .what =
                      "The cable of this joint runs over pulleys on the axis of another joint. The motion "
                      "of that joint winds up the cable, by a share that is missing or wrong in the "
                      "coupling matrix.",
                  .equation = "s_l = r_l (A (q − q_hs)), A(joint, other) = nominal + added",
                  .source =
                      "Lee and Tsai, The structural synthesis of tendon-driven manipulators having a "
                      "pseudotriangular structure matrix, International Journal of Robotics Research 10 "
                      "(1991)",
                  .changes =
                      "Transmission: one number off the diagonal of the coupling matrix A changes; torques "
                      "follow by the transpose of A.",
                  .signature =
                      "Against the position of the other joint, the residual is a straight line, even while "
                      "this joint's motor stands still.",
                  .experiment = "Hold this joint's motor, and sweep each other joint alone over its range.",
              },
          .neutral = {0.0, 1.0},
          .grid = cableCouplingStarts,
      },
      {
          .facts = &factsOf("homing_offset"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Homing at another position",
                  .what =
                      "The joint was homed at another position than that in the robot file, because of a "
                      "bent stop, a mounting error or homing that stopped early. Or the zero of its motor is "
                      "wrong. All positions are off by a constant.",
                  .equation =
                      "q = q_hs + h + A⁻¹ (r_mc q_m / (N r_l)) without stretch; at_motor 0: h is offset at "
                      "this joint and 0 at the others; 1: A h is A(joint, joint) offset at this cable and 0 "
                      "at the others",
                  .source = "Mooring, Roth and Driels, Fundamentals of Manipulator Calibration (1991): joint "
                            "offsets of the kinematic model",
                  .changes = "Transmission: q_hs of this joint or the zero of its motor changes.",
                  .signature =
                      "The residual is constant at every position, direction and speed, in motion and at "
                      "rest. With at_motor above 0, joints whose cables are coupled to this one are off by a "
                      "constant, too. The cameras see the offset rotated by the arm.",
                  .experiment =
                      "Move slowly with rests; home again in between and check whether the constant stays "
                      "the same.",
              },
          .neutral = {0.0, 0.0},
          .grid =
              [](const JointScales& s, int) {
                // If this joint moves no other cable, both forms are the same.
                const double form = s.moves_other_cables ? 0.5 : 0.0;
                return usable({{{0.0, form}, {0.02 * s.range, form}}});
              },
      },
      {
          .facts = &factsOf("zero_drift"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Joint zero that drifts and settles",
                  .what = "After homing, the zero of the joint's cable continued to move, because cables "
                          "settle on "
                          "their pulleys or get warm; the drift is fast at first and then slower and slower.",
                  .equation = "s_l = r_l (A (q − q_hs) − A(joint, joint) drift (1 − exp(−t / "
                              "time_constant))), t from "
                              "the begin of the recording",
                  .source = "Incropera, DeWitt, Bergman and Lavine, Fundamentals of Heat and Mass Transfer "
                            "(2007), chapter 5, lumped capacitance: what warms up does so exponentially, and "
                            "lengths change with it",
                  .changes = "Transmission: the zero of this joint's cable travel changes over time. Joints "
                             "that are coupled "
                             "to this one move with it.",
                  .signature =
                      "Against time, the residual is an exponential that levels out, at every position, "
                      "direction and speed, loaded or not. Unlike a slip it is gradual; unlike creep it "
                      "does not follow the load.",
                  .experiment =
                      "Record from a cold start until the drift levels out, and return to the same pose "
                      "again and again.",
              },
          .neutral = {0.0, 1.0},
          .grid = zeroDriftStarts,
          .least = {std::numeric_limits<double>::lowest(), kDriftsOn},
          // Negative: an approximation of a drift that begins a moment after the recording. Most of it is in
          // the recording: what came before cannot be told from a homing offset.
          .begun = BegunShare{&robot::JointNumbers<double>::zero_drift_begun, 0.0, 0.1, -0.1, 0.3},
      },
      {
          .facts = &factsOf("capstan_eccentricity"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Eccentric motor capstan",
                  .what = "The axis of the motor capstan is off the centre of its drum, or the drum is not "
                          "round: within each revolution it winds up more cable on one side and less on the "
                          "other.",
                  .equation = "s_m = r_mc φ + cosine sin φ + sine (cos φ − 1), φ = q_m / N",
                  .source =
                      "Tuttle and Seering, A nonlinear model of a harmonic drive gear transmission, IEEE "
                      "Transactions on Robotics and Automation 12 (1996): kinematic error by harmonics of "
                      "the rotation; here the first, of a circle turning off its centre",
                  .changes =
                      "Transmission: cable travel and lever of the motor vary sinusoidally with the angle "
                      "of the capstan.",
                  .signature =
                      "Against the capstan's angle modulo one revolution, the residual is a sine of the "
                      "same amplitude at every speed and load.",
                  .experiment = "Sweep slowly over many revolutions of the capstan, both ways.",
              },
          .neutral = {0.0, 0.0},
          .grid =
              [](const JointScales& s, int) {
                return usable({{{0.0, 0.0}, {0.05 * s.capstan, 0.05 * s.capstan}}});
              },
          .background = [](const JointScales& s) { return 1.1e-3 * s.capstan; },
          .size = [](const std::vector<double>& v) { return amplitude(v, 2); },
      },
  };
}

}  // namespace capstan::diagnosis::library
