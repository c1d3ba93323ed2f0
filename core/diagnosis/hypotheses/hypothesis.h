#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/robot/chain/chain_numbers.h"
#include "core/robot/effects.h"

namespace capstan::diagnosis {

/// Part of the chain from motor to camera that an effect belongs to.
enum class Place { kTransmission, kCable, kFriction, kRigidBody, kSensor, kClock };

/// Texts that describe a hypothesis in reports.
struct HypothesisWords {
  std::string_view title;       ///< "Backlash of the cable drive"
  std::string_view what;        ///< the effect in plain words, one or two sentences
  std::string_view equation;    ///< its equation as plain text, with the symbols of the papers
  std::string_view source;      ///< publication that the equation is from
  std::string_view changes;     ///< the change to the model
  std::string_view signature;   ///< how the residual depends on other variables
  std::string_view experiment;  ///< the motion that shows the effect best
};

/// Typical magnitudes of one joint, in SI, from which fits of effects start.
struct JointScales {
  double range = 0.0;      ///< range between the joint limits [rad or m]
  double speed = 0.0;      ///< highest speed in the recording [rad/s or m/s]
  double coulomb = 0.0;    ///< Coulomb friction of the robot file [N·m or N]
  double viscous = 0.0;    ///< viscous friction of the robot file
  double inertia = 0.0;    ///< diagonal of the mass matrix in the middle of the range [kg·m² or kg]
  double radius = 0.0;     ///< link radius r_l [m/rad or m/m]
  double capstan = 0.0;    ///< motor capstan radius r_mc [m]
  double gear = 1.0;       ///< gear ratio N
  double stiffness = 0.0;  ///< cable stiffness 2 k_e a [N/m]; 0: a rigid drive
  double stretch = 0.0;    ///< cable stretch by gravity and friction [m]; 0: a rigid drive
  double load = 0.0;       ///< largest measured load [N·m or N]; 0: loads are not measured
  double duration = 0.0;   ///< duration of the longest recording [s]
  int joints = 1;          ///< number of joints of the robot
  bool moves_other_cables = false;  ///< whether the coupling lets this joint move cables of other joints
};

/// Largest stretch of the nominal cable by gravity, friction and load, over the joint's range.
double stretchOfRange(const JointScales& scales);
/// True if the nominal cable stretches so little that it is practically rigid. Its k_e can then be wrong by
/// more than a fit of k_e reaches.
bool isPracticallyRigid(const JointScales& scales);
/// True for the time of an event, which happens once in a recording.
inline bool isEventTime(const robot::EffectParameter& parameter) { return parameter.name == "time"; }
/// First and last time of an event that is tested [s]: kFromEnds, or a tenth of a short recording, after the
/// begin and before the end. Nearer to an end, a single block of the cross-validation contains nearly all
/// that shows the event, and an error of the initial state has the same residual.
std::pair<double, double> eventTimes(const JointScales& scales);
inline constexpr double kFromEnds = 1.0;

/// One start of a fit: a value and a scale per number, in the order of EffectFacts::parameters. The scale is
/// a large magnitude of the number; a number with scale 0 is not fitted.
struct EffectStart {
  std::vector<double> value;
  std::vector<double> scale;
};

/// Magnitude of the first value, which is the size of most effects.
double firstMagnitude(const std::vector<double>& values);

/// Share of an effect's final state that it had reached when the recording began.
struct BegunShare {
  double robot::JointNumbers<double>::*number;
  double start, scale, low, high;  ///< of the fit
};

/// Physical effect that diagnosis can name as a cause: one entry in the file of its Place in hypotheses/.
struct Hypothesis {
  const robot::EffectFacts* facts;
  Place place;
  HypothesisWords words;
  std::vector<double> neutral;  ///< parameter values at which the model is the nominal one
  /// Starts of fits, not yet clipped to the parameters' bounds; see starts().
  std::vector<EffectStart> (*grid)(const JointScales& scales, int joint);
  /// Size that the effect normally has on a robot in good order, in the unit of size(). Models contain the
  /// effect up to this size as a background effect, which is no cause. 0: no background effect.
  double (*background)(const JointScales& scales) = [](const JointScales&) { return 0.0; };
  /// Least values of parameters in a fit, in their order; of those beyond: that of the facts. What is below
  /// is another effect.
  std::vector<double> least = {};
  std::optional<BegunShare> begun = {};  ///< one more parameter of a fit; empty: the effect has no past
  /// Size of the effect as one number: usually the first parameter's magnitude.
  double (*size)(const std::vector<double>& values) = firstMagnitude;

  std::string_view name() const { return facts->name; }
  /// Starts of fits for joint `joint` (from 1; 0: whole arm): several if the effect is not linear in its
  /// parameters, none if the robot cannot have the effect.
  std::vector<EffectStart> starts(const JointScales& scales, int joint) const;
};

/// All hypotheses, in the order of robot::effectFacts().
const std::vector<Hypothesis>& hypotheses();
/// Hypothesis of this name; null: none.
const Hypothesis* hypothesisNamed(std::string_view name);

}  // namespace capstan::diagnosis
