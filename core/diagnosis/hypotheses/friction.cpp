#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

Starts stribeckFrictionStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.015, 0.04, 0.1})
    all.push_back({{1.0, share * s.speed}, {1.0, 0.5 * share * s.speed}});
  return usable(std::move(all));
}

Starts viscousFrictionStarts(const JointScales& s, int) {
  const double slope = s.coulomb > 0.0 ? 2.0 * s.coulomb / (0.3 * s.speed) : s.viscous;
  return usable({{{0.0}, {slope}}});
}

Starts positionFrictionStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.25, 0.4, 0.6, 0.9}) {
    const double period = share * s.range;
    all.push_back({{0.0, 0.0, period}, {0.5, 0.5, 0.15 * period}});
  }
  return s.range > 0.0 ? usable(std::move(all)) : Starts{};
}

}  // namespace

std::vector<Hypothesis> frictionHypotheses() {
  return {
      {
          .facts = &factsOf("stribeck_friction"),
          .place = Place::kFriction,
          .words =
              {
                  .title = "Friction that is higher at low speed",
                  .what =
                      "Near standstill the lubricant film breaks down, and friction exceeds Coulomb "
                      "friction; it falls to Coulomb friction as speed rises. The joint sticks and jumps.",
                  .equation =
                      "F = F_c (1 + excess exp(−(v / speed)²)) sgn v + F_v v, sgn v smoothed as tanh(v / "
                      "v_eps)",
                  .source =
                      "Armstrong-Hélouvry, Dupont and Canudas de Wit, A survey of models, analysis tools "
                      "and compensation methods for the control of machines with friction, Automatica 30 "
                      "(1994)",
                  .changes = "Friction: the Coulomb friction of this joint depends on its speed.",
                  .signature =
                      "Against velocity, the residual has a pair of peaks of opposite sign beside zero, and "
                      "is zero at high speed. Steps appear where the motion starts.",
                  .experiment =
                      "Move very slowly with many reversals; move at constant speeds, from a hundredth of "
                      "the highest speed upwards.",
              },
          .neutral = {0.0, 1.0},
          .grid = stribeckFrictionStarts,
          .background = [](const JointScales&) { return 0.06; },
          .least = {0.0},
      },
      {
          .facts = &factsOf("asymmetric_friction"),
          .place = Place::kFriction,
          .words =
              {
                  .title = "Friction that differs between the directions",
                  .what =
                      "Friction is higher in one direction than in the other, because of a one-sided seal, "
                      "a worn tooth flank or a cable that climbs out of its groove.",
                  .equation = "F = F_c (1 + d share) tanh(v / v_eps) + F_v v, d = 1 for v > 0, else −1",
                  .source =
                      "Armstrong-Hélouvry, Dupont and Canudas de Wit, A survey of models, analysis tools "
                      "and compensation methods for the control of machines with friction, Automatica 30 "
                      "(1994)",
                  .changes =
                      "Friction: Coulomb friction is multiplied by 1 + share forwards and by 1 − share "
                      "backwards.",
                  .signature =
                      "The residual has the same level in both directions of motion and another one at "
                      "rest: the effect acts like a constant force that is present only in motion. In a "
                      "rigid drive one direction is too fast and the other too slow.",
                  .experiment =
                      "Make equal slow motions both ways, with rests in between; the rests distinguish the "
                      "effect from an offset.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.5}}};
              },
          .background = [](const JointScales&) { return 0.045; },
      },
      {
          .facts = &factsOf("asymmetric_viscosity"),
          .place = Place::kFriction,
          .words =
              {
                  .title = "Viscous friction that differs between the directions",
                  .what = "Grease and seals brake one direction more than the other, or a screw or gear has "
                          "other losses when the motor drives than when it brakes.",
                  .equation = "F = F_c tanh(v / v_eps) + F_v (1 + d share) v, d = 1 for v > 0, else −1",
                  .source =
                      "Armstrong-Hélouvry, Control of Machines with Friction (1991), chapter 3: viscous "
                      "friction identified for each direction of its own",
                  .changes =
                      "Friction: viscous friction is multiplied by 1 + share forwards and by 1 − share "
                      "backwards.",
                  .signature =
                      "The residual is zero in slow motion. In fast motion it has the same sign both ways "
                      "and grows with speed.",
                  .experiment = "Move along equal paths both ways at a low, a middle and the highest speed.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.3}}};
              },
      },
      {
          .facts = &factsOf("viscous_friction"),
          .place = Place::kFriction,
          .words =
              {
                  .title = "Viscous friction other than the model's",
                  .what =
                      "Grease, seals or eddy currents brake in proportion to speed, more or less than the "
                      "robot file says.",
                  .equation = "F = F_c sgn v + (F_v + added) v, sgn v smoothed as tanh(v / v_eps)",
                  .source =
                      "Siciliano, Sciavicco, Villani and Oriolo, Robotics: Modelling, Planning and Control "
                      "(2009), joint friction torques",
                  .changes = "Friction: the viscous friction F_v of this joint changes.",
                  .signature =
                      "Against velocity, the residual is a straight line through zero. In a rigid drive "
                      "fast motions are too large or too small, and slow motions less so.",
                  .experiment = "Follow the same path at a low, a middle and the highest speed.",
              },
          .neutral = {0.0},
          .grid = viscousFrictionStarts,
      },
      {
          .facts = &factsOf("load_friction"),
          .place = Place::kFriction,
          .words =
              {
                  .title = "Friction that grows with load",
                  .what = "Bearings, gears and cables on their idlers have more friction the more force they "
                          "transmit: a share of the driving torque is lost.",
                  .equation =
                      "F = (F_c + share |Γ|) sgn v + F_v v, Γ the torque of the cable or motor at the joint",
                  .source = "Hamon, Gautier and Garrec, Dynamic identification of robots with a dry friction "
                            "model depending on load and velocity, IROS 2010",
                  .changes =
                      "Friction: Coulomb friction of this joint grows with the magnitude of the driving "
                      "torque.",
                  .signature =
                      "The residual differs between the directions of motion, and the difference grows with "
                      "the magnitude of the torque, whatever its sign.",
                  .experiment = "Move slowly both ways under no load, a middle load and a high load.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.3}}};
              },
      },
      {
          .facts = &factsOf("position_friction"),
          .place = Place::kFriction,
          .words =
              {
                  .title = "Friction that varies periodically with the position",
                  .what = "A bent shaft, an eccentric bearing or pulley, or the teeth of a gear cause more "
                          "friction at some positions than at others, with a constant period.",
                  .equation =
                      "F = F_c (1 + sine sin(2π q / period) + cosine cos(2π q / period)) sgn v + F_v v",
                  .source = "Popović and Goldenberg, Modeling of friction using spectral analysis, IEEE "
                            "Transactions on Robotics and Automation 14 (1998)",
                  .changes = "Friction: the Coulomb friction of this joint depends on its position.",
                  .signature =
                      "Against the joint's position, the residual is a wave whose sign changes with the "
                      "direction of motion.",
                  .experiment = "Sweep slowly over the whole range both ways, at one speed and one load.",
              },
          .neutral = {0.0, 0.0, 1.0},
          .grid = positionFrictionStarts,
          .size = [](const std::vector<double>& v) { return amplitude(v, 2); },
      },
  };
}

}  // namespace capstan::diagnosis::library
