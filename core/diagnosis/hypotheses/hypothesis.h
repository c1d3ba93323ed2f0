#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/robot/effects.h"

namespace capstan::diagnosis {

/// Where in the chain from motor to camera an effect sits.
enum class Place { kTransmission, kCable, kFriction, kRigidBody, kSensor, kClock };

/// Description of a hypothesis in reports.
struct HypothesisWords {
  std::string_view title;       ///< "Backlash of the cable drive"
  std::string_view what;        ///< in plain words, one or two sentences
  std::string_view equation;    ///< plain text, symbols of the papers
  std::string_view source;      ///< where the equation is from
  std::string_view changes;     ///< what it does to the model
  std::string_view signature;   ///< how the residual looks
  std::string_view experiment;  ///< the motion that would show it best
};

/// The sizes that a robot's numbers suggest, for starts of fits: SI, of one joint.
struct JointScales {
  double range = 0.0;      ///< of the joint limits [rad or m]
  double speed = 0.0;      ///< top speed that the recording shows [rad/s or m/s]
  double coulomb = 0.0;    ///< refitted Coulomb friction [N·m or N]
  double viscous = 0.0;    ///< refitted viscous friction
  double inertia = 0.0;    ///< of the mass matrix's diagonal at the middle [kg·m² or kg]
  double radius = 0.0;     ///< r_l [m/rad or m/m]
  double capstan = 0.0;    ///< r_mc [m]
  double gear = 1.0;       ///< N
  double stiffness = 0.0;  ///< 2 k_e a [N/m]; 0: a rigid drive
  double stretch = 0.0;    ///< largest of the cable in the recording, simulated [m]
  double load = 0.0;       ///< largest that is measured [N·m or N]; 0: none is
  double duration = 0.0;   ///< of the recording [s]
  int joints = 1;
};

/// One start of a fit: values in the order of EffectFacts::parameters. Each carries its scale, the size that
/// would be large; 0 keeps the value as it is in this fit.
struct EffectStart {
  std::vector<double> value;
  std::vector<double> scale;
};

/// |first value|, which most sizes are.
double firstMagnitude(const std::vector<double>& values);

/// A physical cause that diagnosis can name: an entry in the file of its Place in hypotheses/.
struct Hypothesis {
  const robot::EffectFacts* facts;
  Place place;
  HypothesisWords words;
  std::vector<double> neutral;  ///< values of its parameters at which the model is the nominal one
  /// Starts before they are brought within the parameters' bounds, see starts().
  std::vector<EffectStart> (*grid)(const JointScales& scales, int joint);
  /// Size up to which it is a background effect, in the unit of size(); 0: never.
  double (*background)(const JointScales& scales) = [](const JointScales&) { return 0.0; };
  bool remembers = false;  ///< what was before the recording: how far, is one more number of a fit
  /// Size of the effect as one number: usually the first parameter's magnitude.
  double (*size)(const std::vector<double>& values) = firstMagnitude;

  std::string_view name() const { return facts->name; }
  /// Grid of starts for joint `joint` (from 1; 0: whole arm): shapes that are not linear in their numbers
  /// have several. Never empty where the hypothesis makes sense.
  std::vector<EffectStart> starts(const JointScales& scales, int joint) const;
};

/// The library, in the order of robot::effectFacts().
const std::vector<Hypothesis>& hypotheses();
/// Null: none of this name.
const Hypothesis* hypothesisNamed(std::string_view name);

}  // namespace capstan::diagnosis
