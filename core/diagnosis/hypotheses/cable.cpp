#include <numbers>

#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

constexpr double kAsRigid = 0.01;  // of the range: a stretch that makes no difference
constexpr double kLarge = 0.1;     // likewise, that makes a large one

/// In a cable drive linear in its number, from none of it on; what is large goes by the nominal stiffness,
/// and where that is as good as rigid by what the forces of the recording would show. In a rigid drive no
/// spring is an infinitely stiff one, so that starts have one, by resonance.
Starts cableComplianceStarts(const JointScales& s, int) {
  Starts all;
  if (s.stiffness > 0.0) {
    all.push_back({{0.0}, {1.0 / s.stiffness}});
    const double stretch = s.stretch + s.load / s.radius / s.stiffness;
    const double given = stretch / (s.radius * s.range);  // of the range, by the nominal cable
    if (given < kAsRigid) all.push_back({{0.0}, {kLarge / given / s.stiffness}});
    return usable(std::move(all));
  }
  for (const double resonance : {5.0, 10.0, 20.0}) {  // of the joint on the spring, the motor held [Hz]
    const double rate = 2.0 * std::numbers::pi * resonance;
    const double compliance = s.radius * s.radius / (s.inertia * rate * rate);
    all.push_back({{compliance}, {compliance}});
  }
  return usable(std::move(all));
}

Starts backlashStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.3, 1.0}) all.push_back({{share * s.stretch}, {0.3 * s.stretch}});
  return usable(std::move(all));
}

constexpr double kNone = 1e3;    // a pretension that no load uses up [m]
constexpr double kLeast = 1e-6;  // below it 1 / pretension goes on along its tangent [m]

Starts slackStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.6, 0.2, -0.3}) all.push_back({{share * s.stretch}, {0.3 * s.stretch}});
  return usable(std::move(all));
}

/// Its size is 1 / pretension [1/m] less that of the neutral one: it rises as pretension falls, through 0
/// into what is too long.
double slackSize(const std::vector<double>& v) {
  const double p = v.at(0);
  if (p >= kNone) return 0.0;
  return p >= kLeast ? 1.0 / p - 1.0 / kNone : (2.0 - p / kLeast) / kLeast - 1.0 / kNone;
}

Starts cableHysteresisStarts(const JointScales& s, int) {
  const double force = s.coulomb > 0.0 ? s.coulomb / s.radius : 0.1 * s.stiffness * s.stretch;
  Starts all;
  for (const double share : {0.1, 0.3, 0.8}) {
    const double yield = share * force / s.stiffness;
    all.push_back({{force, yield}, {force, 0.5 * yield}});
  }
  return usable(std::move(all));
}

Starts cableCreepStarts(const JointScales&, int) {
  Starts all;
  for (const double seconds : {0.5, 1.5, 5.0}) all.push_back({{0.5, seconds}, {0.5, 0.5 * seconds}});
  return all;
}

}  // namespace

std::vector<Hypothesis> cableHypotheses() {
  return {
      {
          .facts = &factsOf("cable_compliance"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Cable softer than the model's",
                  .what =
                      "Something gives between motor and joint that the model takes for rigid, or for "
                      "stiffer: cable terminations, idlers, their brackets, or the whole cable of a drive "
                      "modelled without one.",
                  .equation =
                      "δ = δ_cable(γ) + compliance γ; in a rigid drive γ = δ / compliance, δ = r_mc q_m / N "
                      "− r_l (q − q_hs), with motor and joint masses of their own",
                  .source =
                      "Spong, Modeling and control of elastic joint robots, Journal of Dynamic Systems, "
                      "Measurement, and Control 109 (1987)",
                  .changes =
                      "Cable: a linear spring in series with the nominal cable. In a rigid drive motor and "
                      "joint become two masses with a spring between them.",
                  .signature =
                      "In proportion to the torque at the joint, that of gravity, load and friction; in a "
                      "rigid drive a ringing after every change of torque, and the more the faster the "
                      "motion.",
                  .experiment =
                      "Press against the joint with a known load while the motor holds; in a rigid drive, "
                      "steps of torque or a sweep of frequency over the resonance.",
              },
          .neutral = {0.0},
          .grid = cableComplianceStarts,
      },
      {
          .facts = &factsOf("cable_stiffening"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Cable that stiffens as it stretches",
                  .what = "Strands of a wire rope settle and bear together, so that the cable is stiffer the "
                          "more it is stretched, more than the nominal exponential law says.",
                  .equation = "γ = 2 k_e sinh(a δ) + 2 k_e a cubic δ³",
                  .source =
                      "Kovacic and Brennan, The Duffing Equation (2011): odd power series of a symmetric "
                      "spring to third order; nominal law Haghighipanah, Miyasaka, Li and Hannaford, "
                      "Unscented Kalman filter and 3D vision to improve cable driven surgical robot joint "
                      "angle estimation, ICRA 2016, (5) and (6)",
                  .changes =
                      "Cable: a cubic term beside the nominal force; small stretches feel nothing of it.",
                  .signature =
                      "Against the joint's torque or the stretch a curve that is flat in the middle and "
                      "bends at both ends, away from the load: at high load the joint gives way less than "
                      "simulated.",
                  .experiment =
                      "Loads up to the highest allowed, both ways, slowly; small loads alone do not show "
                      "it.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales& s, int) {
                return usable({{{0.0}, {1.0 / (s.stretch * s.stretch)}}});
              },
      },
      {
          .facts = &factsOf("position_stiffness"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Stiffness that depends on the position",
                  .what =
                      "The free length of the cable grows as the joint moves over its range, and a longer "
                      "cable is softer.",
                  .equation =
                      "γ = 2 k_e sinh(a δ) / (1 + share x) + 2 b_e dδ/dt, x = −1 … 1 from the lower to the "
                      "upper limit, |x| ≤ 1.2",
                  .source =
                      "Werkmeister and Slocum, Theoretical and experimental determination of capstan drive "
                      "stiffness, Precision Engineering 31 (2007): stiffness E A / L of the free length L",
                  .changes = "Cable: the stiffness of both cables of this joint, by its position.",
                  .signature =
                      "In proportion to the torque at the joint, with one sign near one end of the range "
                      "and with the other near the other end.",
                  .experiment = "The same load at both ends of the range and in the middle.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.4}}};
              },
      },
      {
          .facts = &factsOf("backlash"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Backlash",
                  .what =
                      "There is play between motor and joint, in the gear, a key or a cable end: when the "
                      "force changes sides, the motor crosses the play before it moves the joint.",
                  .equation =
                      "γ = 2 k_e sinh(a (|δ| − half_width)₊ sgn δ) + 2 b_e dδ/dt, 0 within the play; it "
                      "presses and never pulls",
                  .source = "Nordin and Gutman, Controlling mechanical systems with backlash: a survey, "
                            "Automatica 38 (2002)",
                  .changes =
                      "Cable: no force while the stretch is within ± half_width, and the nominal law beyond "
                      "it.",
                  .signature =
                      "Two levels, half_width / r_l apart from the middle, one for each side of the force: "
                      "against the direction of motion where friction is the force, against the sign of the "
                      "torque where gravity or load is. Steps at reversals.",
                  .experiment =
                      "Slow reversals with little load, where friction changes the side; then the same "
                      "against a constant load, under which the steps disappear.",
              },
          .neutral = {0.0},
          .grid = backlashStarts,
      },
      {
          .facts = &factsOf("slack"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Lost pretension",
                  .what =
                      "The pair of cables has lost its pretension: beyond some stretch one of them sags and "
                      "the other one is alone, half as stiff. If both are too long, there is a stretch in "
                      "which neither pulls.",
                  .equation =
                      "γ = f(pretension + δ) − f(pretension − δ), f(x) = k_e a x for x > 0, else 0; damping "
                      "where a cable is taut",
                  .source =
                      "Palli, Borghesan and Melchiorri, Modeling, identification, and control of "
                      "tendon-based actuation systems, IEEE Transactions on Robotics 28 (2012): tendons "
                      "pull only",
                  .changes = "Cable: two cables that can only pull take the place of the nominal law.",
                  .signature =
                      "Against the joint's torque nothing in the middle and a straight line beyond a corner "
                      "on either side: at high load the joint gives way more than simulated. With both "
                      "cables too long two levels, as backlash has, and soft beyond.",
                  .experiment =
                      "Loads that rise slowly through the corner, both ways; small motions about rest for a "
                      "pair that is too long.",
              },
          .neutral = {kNone},
          .grid = slackStarts,
          .size = slackSize,
      },
      {
          .facts = &factsOf("cable_hysteresis"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Hysteresis of the cable",
                  .what =
                      "Strands and sheaths rub on one another as the cable stretches: force follows stretch "
                      "in a loop that does not depend on speed.",
                  .equation =
                      "γ = γ_nominal + force z / yield, dz/dt = dδ/dt − (|dδ/dt| z + dδ/dt |z|) / (2 yield)",
                  .source =
                      "Wen, Method for random vibration of hysteretic systems, Journal of the Engineering "
                      "Mechanics Division, ASCE 102 (1976), with his n = 1, A = 1 and β = γ = 1 / (2 yield)",
                  .changes = "Cable: a Bouc–Wen element beside the nominal cable, with one state more.",
                  .signature =
                      "A loop against stretch or torque that is as wide at low speed as at high; after a "
                      "reversal the residual turns over within the yield stretch.",
                  .experiment =
                      "The motor held, load and unload the joint slowly, in large and in small loops.",
              },
          .neutral = {0.0, 1e-4},
          .grid = cableHysteresisStarts,
      },
      {
          .facts = &factsOf("cable_creep"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Creeping cable",
                  .what =
                      "Under load the cable goes on stretching for seconds, and takes as long to recover, "
                      "as polymer fibres and rope cores do.",
                  .equation = "dx_c/dt = (share (δ − x_c) − x_c) / time_constant, γ = γ_nominal(δ − x_c)",
                  .source =
                      "Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials "
                      "(1976): Kelvin–Voigt element in series with a spring",
                  .changes =
                      "Cable: a spring and damper in series with the nominal cable, with one state more.",
                  .signature =
                      "After a change of load an exponential against time; the residual follows the torque "
                      "with a lag, and at slow motion more than at fast.",
                  .experiment =
                      "Put a load on, hold still for several time constants, take it off and hold again.",
              },
          .neutral = {0.0, 1.0},
          .grid = cableCreepStarts,
          .remembers = true,
      },
  };
}

}  // namespace capstan::diagnosis::library
