#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/experiments/specification.h"
#include "core/identification/batch.h"
#include "core/identification/convergence.h"
#include "core/identification/dual_ukf.h"
#include "core/robot/description.h"

/// What is made of an identification: whose estimates count, in which words, in which robot file.
namespace capstan::experiments {

/// Whose estimates an identification leaves.
struct Choice {
  std::optional<Method> method;  ///< none: nothing was identified
  std::string words;             ///< why it is not the requested method; empty: it is
};

/// The method `requested` where it ended with estimates, else the other one, else none. A method that was
/// cancelled, failed or had no observation leaves none, nor does one whose numbers are not finite; null: it
/// was not requested.
Choice choose(Method requested, const identification::DualUkfReport* dual,
              const identification::BatchReport* batch);

/// An end of either report (base::nameOf) that leaves estimates.
bool foundSomething(const std::string& end);

/// identification::wordsOf(), and where σ has not reached its goal, what the two are:
/// "about 90 s more of this motion (σ is 8.3 %, its goal 5 %)".
std::string progressWords(const identification::Convergence& convergence,
                          const identification::Estimate& estimate);

/// Where the parameters of a robot file come from.
struct RobotOrigin {
  std::vector<std::string> recordings;  ///< names, or what was simulated
  double duration = 0.0;                ///< of their motor samples [s]; 0: not known
  std::string method;                   ///< "dual UKF", "batch", …
  std::vector<std::string> values;      ///< a line each: "r_l1 59.012 ± 0.011 mm"
  std::string software;                 ///< program and version; empty: not said
};

/// "r_l1 59.012 ± 0.011 mm", or "b_e1 not seen, as before".
std::string valueLine(const std::string& name, double value, double sigma, const std::string& unit,
                      bool seen);

/// The robot file of `identified`, its origin and what differs from `nominal` in comments on top:
/// robot::parseDescription() gives `identified` back to the last bit.
std::string identifiedRobotText(const robot::Description& nominal, const robot::Description& identified,
                                const RobotOrigin& origin);

}  // namespace capstan::experiments
