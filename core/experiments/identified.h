#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/experiments/specification.h"
#include "core/identification/batch.h"
#include "core/identification/convergence.h"
#include "core/identification/dual_ukf.h"
#include "core/robot/description.h"

/// Use of an identification: choice of the method, texts, robot file.
namespace capstan::experiments {

/// Choice of the method whose estimates are used.
struct Choice {
  std::optional<Method> method;  ///< none: nothing was identified
  std::string words;             ///< reason why it is not the requested method; else empty
};

/// Chooses `requested` where it has estimates, else the other method, else none. A method that was cancelled,
/// failed, had no observation or gave numbers that are not finite has no estimates. Null: the method was not
/// run.
Choice choose(Method requested, const identification::DualUkfReport* dual,
              const identification::BatchReport* batch);

/// True when a report with this end (base::nameOf) has estimates.
bool foundSomething(const std::string& end);

/// Text of identification::wordsOf(); where σ has not reached its goal, with both numbers:
/// "about 90 s more of this motion are needed (σ is 8.3 %, its goal 5 %)".
std::string progressWords(const identification::Convergence& convergence,
                          const identification::Estimate& estimate);

/// Origin of the parameters of a robot file.
struct RobotOrigin {
  std::vector<std::string> recordings;  ///< names of recordings or simulations
  double duration = 0.0;                ///< total duration of their motor samples [s]; 0: not known
  std::string method;                   ///< "dual UKF", "batch", …
  std::vector<std::string> values;      ///< one line per parameter: "r_l1 59.012 ± 0.011 mm"
  std::string software;                 ///< program and version; empty: not known
};

/// Line of one parameter: "r_l1 59.012 ± 0.011 mm", or "b_e1 not observable, as before".
std::string valueLine(const std::string& name, double value, double sigma, const std::string& unit,
                      bool seen);

/// Robot file of `identified`. Comments at the top give its origin and its differences from `nominal`.
/// robot::parseDescription() returns `identified` exactly.
std::string identifiedRobotText(const robot::Description& nominal, const robot::Description& identified,
                                const RobotOrigin& origin);

}  // namespace capstan::experiments
