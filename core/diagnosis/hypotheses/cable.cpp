#include <numbers>

#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

constexpr double kLarge = 0.1;  // stretch that has a large effect, over the joint's range

/// Starts of a compliance. In a cable drive the effect is linear in its parameter and starts at 0; its scale
/// is the nominal compliance, or that of a large stretch if the nominal cable is practically rigid. In a
/// rigid drive no value means an infinitely stiff spring, so that fits start from springs with typical
/// resonances.
Starts cableComplianceStarts(const JointScales& s, int) {
  Starts all;
  if (s.stiffness > 0.0) {
    all.push_back({{0.0}, {1.0 / s.stiffness}});
    if (isPracticallyRigid(s)) all.push_back({{0.0}, {kLarge / stretchOfRange(s) / s.stiffness}});
    return usable(std::move(all));
  }
  for (const double resonance : {5.0, 10.0, 20.0}) {  // of the joint on the spring with the motor held [Hz]
    const double rate = 2.0 * std::numbers::pi * resonance;
    const double compliance = s.radius * s.radius / (s.inertia * rate * rate);
    all.push_back({{compliance}, {compliance}});
  }
  return usable(std::move(all));
}

constexpr double kAlways = 2.0;  // value of a backlash's `damping`

/// One start for each form of the damper: the law has a kink at damping 1.
Starts backlashStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {0.3, 1.0})
    for (const double damping : {0.0, 1.0, 2.0})
      all.push_back({{share * s.stretch, damping}, {0.3 * s.stretch, 1.0}});
  return usable(std::move(all));
}

constexpr double kNone = 1e3;    // pretension that no load exceeds [m]
constexpr double kLeast = 1e-6;  // the least pretension that differs from none [m]

Starts slackStarts(const JointScales& s, int) {
  Starts all;
  for (const double share : {6.0, 2.0, 0.6, 0.2})  // accelerations and loads stretch it further than gravity
    all.push_back({{share * s.stretch}, {std::max(0.3, 0.5 * share) * s.stretch}});
  return usable(std::move(all));
}

/// Size of slack: 1 / pretension [1/m] minus its neutral value. Two cables that are too long are a backlash.
double slackSize(const std::vector<double>& v) {
  return 1.0 / std::clamp(v.at(0), kLeast, kNone) - 1.0 / kNone;
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
                      "A part between motor and joint is softer than the model says, or the model takes it "
                      "as rigid: cable terminations, idlers, their brackets, or the whole cable of a drive "
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
                      "The residual is proportional to the torque at the joint (gravity, load and "
                      "friction). In a rigid drive it rings after every change of torque, more in faster "
                      "motion.",
                  .experiment =
                      "Press against the joint with a known load while the motor holds. In a rigid drive, "
                      "apply steps of torque or a frequency sweep over the resonance.",
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
                  .what = "The strands of a wire rope settle and share the load, so that the cable becomes "
                          "stiffer with stretch than the nominal exponential law says.",
                  .equation = "γ = 2 k_e sinh(a δ) + 2 k_e a cubic δ³",
                  .source =
                      "Kovacic and Brennan, The Duffing Equation (2011): odd power series of a symmetric "
                      "spring to third order; nominal law Haghighipanah, Miyasaka, Li and Hannaford, "
                      "Unscented Kalman filter and 3D vision to improve cable driven surgical robot joint "
                      "angle estimation, ICRA 2016, (5) and (6)",
                  .changes =
                      "Cable: a cubic term is added to the nominal force; it has no effect at small stretch.",
                  .signature =
                      "Against the joint torque or the stretch, the residual is flat in the middle and "
                      "bends at both ends, away from the load: at high load the joint moves less than "
                      "simulated.",
                  .experiment =
                      "Apply loads up to the highest allowed, both ways, slowly; small loads alone do not "
                      "show the effect.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales& s, int) {  // JointScales::stretch is that of one pose
                return usable({{{0.0}, {10.0 / (s.stretch * s.stretch)}}});
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
                      "γ = 2 k_e sinh(a δ) (1 − (1 − of_length) share x) / (1 + of_length share x) + 2 b_e "
                      "dδ/dt, x = −1 … 1 from the lower to the upper limit, |x| ≤ 1.2, numerator and "
                      "denominator at least 0.04",
                  .source =
                      "Werkmeister and Slocum, Theoretical and experimental determination of capstan drive "
                      "stiffness, Precision Engineering 31 (2007): stiffness E A / L of the free length L",
                  .changes = "Cable: the stiffness of both cables of this joint depends on its position.",
                  .signature =
                      "The residual is proportional to the torque at the joint, with opposite signs near "
                      "the two ends of the range.",
                  .experiment = "Apply the same load at both ends of the range and in the middle.",
              },
          .neutral = {0.0, 1.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0, 0.5}, {0.4, 0.5}}};
              },
      },
      {
          .facts = &factsOf("backlash"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Backlash",
                  .what =
                      "There is play between motor and joint, in the gear, a key or a cable end. When the "
                      "force changes sign, the motor crosses the play before it moves the joint.",
                  .equation =
                      "γ = 2 k_e sinh(a (|δ| − half_width)₊ sgn δ) + 2 b_e dδ/dt, with a damper that depends "
                      "on damping: 0: γ presses and never pulls; 1: the damper acts while |δ| > half_width; "
                      "2: always; values between are interpolated",
                  .source = "Nordin and Gutman, Controlling mechanical systems with backlash: a survey, "
                            "Automatica 38 (2002)",
                  .changes =
                      "Cable: the spring has no force while the stretch is within ± half_width, and the "
                      "nominal law beyond it. The damper acts as `damping` says.",
                  .signature =
                      "The residual has two levels, ± half_width / r_l, one for each sign of the force. The "
                      "sign is opposite to the direction of motion where friction dominates, and to that of "
                      "the torque where gravity or load dominates. Steps appear at reversals.",
                  .experiment =
                      "Reverse slowly with little load, where friction changes the sign of the force; then "
                      "repeat against a constant load, under which the steps disappear.",
              },
          .neutral = {0.0, kAlways},
          .grid = backlashStarts,
      },
      {
          .facts = &factsOf("slack"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Lost pretension",
                  .what =
                      "The pair of cables has lost its pretension: beyond some stretch one cable sags, and "
                      "the other one alone is half as stiff. Two cables that are both too long are a "
                      "backlash.",
                  .equation =
                      "γ = f(pretension + δ) − f(pretension − δ), f(x) = k_e a x for x > 0, else 0; damping "
                      "where a cable is taut",
                  .source =
                      "Palli, Borghesan and Melchiorri, Modeling, identification, and control of "
                      "tendon-based actuation systems, IEEE Transactions on Robotics 28 (2012): tendons "
                      "pull only",
                  .changes = "Cable: two cables that can only pull replace the nominal law.",
                  .signature =
                      "Against the joint torque, the residual is zero in the middle and a straight line "
                      "beyond a corner on either side: at high load the joint moves more than simulated.",
                  .experiment = "Apply loads that rise slowly through the corner, both ways.",
              },
          .neutral = {kNone},
          .grid = slackStarts,
          .least = {0.0},
          .size = slackSize,
      },
      {
          .facts = &factsOf("cable_hysteresis"),
          .place = Place::kCable,
          .words =
              {
                  .title = "Hysteresis of the cable",
                  .what =
                      "Strands and sheaths rub against each other as the cable stretches: the force follows "
                      "the stretch in a loop that does not depend on speed.",
                  .equation =
                      "γ = γ_nominal + force z / yield, dz/dt = dδ/dt − (|dδ/dt| z + dδ/dt |z|) / (2 yield)",
                  .source =
                      "Wen, Method for random vibration of hysteretic systems, Journal of the Engineering "
                      "Mechanics Division, ASCE 102 (1976), with his n = 1, A = 1 and β = γ = 1 / (2 yield)",
                  .changes = "Cable: a Bouc–Wen element with one more state is added to the nominal cable.",
                  .signature =
                      "Against stretch or torque, the residual is a loop of the same width at low and at "
                      "high speed. After a reversal it changes sign within the yield stretch.",
                  .experiment =
                      "Hold the motor, and load and unload the joint slowly, in large and in small loops.",
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
                      "Under load the cable continues to stretch for seconds, and recovers as slowly, like "
                      "polymer fibres and rope cores.",
                  .equation = "dx_c/dt = (share (δ − x_c) − x_c) / time_constant, γ = γ_nominal(δ − x_c)",
                  .source =
                      "Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials "
                      "(1976): Kelvin–Voigt element in series with a spring",
                  .changes =
                      "Cable: a spring and damper with one more state are added in series with the nominal "
                      "cable.",
                  .signature =
                      "After a change of load, the residual is an exponential over time. It follows the "
                      "torque with a lag, and is larger in slow motion than in fast motion.",
                  .experiment =
                      "Apply a load, hold still for several time constants, remove the load and hold still "
                      "again.",
              },
          .neutral = {0.0, 1.0},
          .grid = cableCreepStarts,
          // Loads before the recording may have been larger.
          .begun = BegunShare{&robot::JointNumbers<double>::creep_begun, 0.5, 0.5, -1.0, 2.0},
      },
  };
}

}  // namespace capstan::diagnosis::library
