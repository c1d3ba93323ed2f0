#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

/// A start for each other joint, which a fit keeps.
Starts cableCouplingStarts(const JointScales& s, int joint) {
  Starts all;
  for (int other = 1; other <= s.joints; ++other)
    if (other != joint) all.push_back({{0.0, static_cast<double>(other)}, {0.05, 0.0}});
  return usable(std::move(all));
}

/// Times against the recording's: what has seated early and what goes on to its end look different.
Starts zeroDriftStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.05, 0.15, 0.4}) {
    const double time = share * s.duration;
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
                  .what =
                      "The pulley that turns the joint is larger or smaller than the robot file says, by a "
                      "worn groove, another cable diameter or a wrong drawing: a revolution of the motor "
                      "moves "
                      "the joint less or more.",
                  .equation =
                      "s_l = r_l (1 + share) (A (q − q_hs)), hence q − q_hs is the nominal one / (1 + "
                      "share)",
                  .source =
                      "Haghighipanah, Miyasaka, Li and Hannaford, Unscented Kalman filter and 3D vision to "
                      "improve cable driven surgical robot joint angle estimation, ICRA 2016, (3) and (4): "
                      "r_l is its most uncertain number",
                  .changes = "Transmission: the link radius r_l of this joint is multiplied by 1 + share.",
                  .signature =
                      "A straight line against the joint's own position that is zero at the hard stop, the "
                      "same in both directions of motion and at every speed.",
                  .experiment =
                      "Slow sweeps over the whole range without load; how far the joint travels matters, "
                      "not how fast.",
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
                  .title = "Motion of another joint carried over by the cable",
                  .what =
                      "The cable of this joint runs over pulleys on the axis of another joint, whose motion "
                      "winds it up by a share that the coupling matrix lacks or has wrong.",
                  .equation = "s_l = r_l (A (q − q_hs)), A(joint, other) = nominal + added",
                  .source =
                      "Lee and Tsai, The structural synthesis of tendon-driven manipulators having a "
                      "pseudotriangular structure matrix, International Journal of Robotics Research 10 "
                      "(1991)",
                  .changes =
                      "Transmission: one number off the diagonal of the coupling matrix A; torques follow "
                      "by its transpose.",
                  .signature =
                      "A straight line against the position of the other joint, also while this joint's "
                      "motor stands still.",
                  .experiment = "Hold this joint's motor and sweep each other joint alone over its range.",
              },
          .neutral = {0.0, 1.0},
          .grid = cableCouplingStarts,
      },
      {
          .facts = &factsOf("homing_offset"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Hard stop elsewhere",
                  .what = "The joint was homed at a position other than the one in the robot file, by a bent "
                          "stop, a mounting error or homing that stopped early: every position is off by one "
                          "constant.",
                  .equation = "q = (q_hs + offset) + A⁻¹ (r_mc q_m / (N r_l)) without stretch",
                  .source = "Mooring, Roth and Driels, Fundamentals of Manipulator Calibration (1991): joint "
                            "offsets of the kinematic model",
                  .changes = "Transmission: the position q_hs at the hard stop of this joint.",
                  .signature =
                      "A constant, at every position, direction and speed, moving or at rest; joints whose "
                      "cables are coupled to this one are off by a constant, too. Cameras see it rotated by "
                      "the arm.",
                  .experiment =
                      "Any slow motion with rests; home again in between and see whether the constant stays.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales& s, int) {
                return usable({{{0.0}, {0.02 * s.range}}});
              },
      },
      {
          .facts = &factsOf("zero_drift"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Zero that drifts and settles",
                  .what =
                      "After the arm was homed the joint's zero went on moving, by cables that seat on their "
                      "pulleys or get warm, fast in the beginning and then less and less.",
                  .equation = "q_hs(t) = q_hs + drift (1 − exp(−t / time_constant)), t from the begin of the "
                              "recording",
                  .source = "Incropera, DeWitt, Bergman and Lavine, Fundamentals of Heat and Mass Transfer "
                            "(2007), chapter 5, lumped capacitance: what warms up does so exponentially, and "
                            "lengths change with it",
                  .changes =
                      "Transmission: the position q_hs at the hard stop of this joint, by the time that has "
                      "passed.",
                  .signature =
                      "An exponential against time that levels out, at every position, direction and speed, "
                      "moving or at rest, loaded or not; it comes neither at once, as a slip, nor with the "
                      "load, as creep.",
                  .experiment =
                      "Record from a cold start, long enough for the drift to level out, and go back to the "
                      "same pose again and again.",
              },
          .neutral = {0.0, 1.0},
          .grid = zeroDriftStarts,
      },
      {
          .facts = &factsOf("capstan_eccentricity"),
          .place = Place::kTransmission,
          .words =
              {
                  .title = "Eccentric motor capstan",
                  .what =
                      "The axis of the motor capstan is off the centre of its drum, or the drum is out of "
                      "round: in each turn it takes up more cable on one side and less on the other.",
                  .equation = "s_m = r_mc φ + cosine sin φ + sine (cos φ − 1), φ = q_m / N",
                  .source =
                      "Tuttle and Seering, A nonlinear model of a harmonic drive gear transmission, IEEE "
                      "Transactions on Robotics and Automation 12 (1996): kinematic error by harmonics of "
                      "the rotation; here the first, of a circle turning off its centre",
                  .changes = "Transmission: cable travel and lever of the motor wave once a revolution of "
                             "the capstan.",
                  .signature =
                      "A sine against the capstan's angle modulo one turn, of one height at every speed and "
                      "load.",
                  .experiment = "Slow sweeps over many turns of the capstan, both ways.",
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
