#pragma once

#include <string>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {

/// Share of the residual beyond noise that the selected effects explain, between 0 and 1:
/// 1 − (S_after − n noise²) / (S_before − n noise²), in the channel with the largest ratio of residual to
/// noise (of the sensor, of the simulation's inputs and of motor torques between the rows).
double explainedShare(const FitData& data, const Selection& selection);

/// Largest mean square of channel c that noise alone can cause: noise of its sensor, of the simulation's
/// inputs and of motor torques between the rows.
double mostByChance(const FitData& data, const Selection& selection, Eigen::Index c);

/// True if the residual of the selected model is more than noise and the tolerance: the mean square of some
/// channel exceeds mostByChance() plus the squared tolerance, and the residual is correlated in time or far
/// above that limit.
bool hasResidual(const FitData& data, const Selection& selection, const Tolerance& tolerance);
inline constexpr double kBeyondNoise = 1.2;  ///< largest ratio of RMS to sensor noise that can be noise alone
/// Smallest explained share at which the effects are the verdict although a residual remains that a
/// regression could explain, unless the effects fallsShort() of the regression.
inline constexpr double kExplains = 0.96;

/// Titles of the causes with their joints: "Backlash (joint 2) and Payload".
std::string causeNames(const std::vector<Cause>& causes);

/// Standard deviation of a parameter, from that of its fit and from kLawError.
double withLawError(double sigma, double value);
/// Standard deviation of a parameter, as a share of it, that simplified laws, the clock of a recording and
/// integration steps cause at least.
inline constexpr double kLawError = 0.01;

/// Adds an effect to the causes if it is material (isMaterial(), and kMaterialShare of the residual without
/// it), else to the effects that are also measurable. `without`, `with`: held-out residuals.
void addCause(Cause cause, const BlockSquares& without, const BlockSquares& with, Report& report);

/// Tie of a cause with other effects. `probabilities`: of the cause, then of the others.
Tie tieOf(const Cause& cause, const std::vector<NamedEffect>& others,
          const std::vector<double>& probabilities);

/// Adds the ties of the report's causes, in their order.
template <class Effect>
void addTies(const std::vector<CompetitorsOf<Effect>>& competitors, Report& report) {
  for (const Cause& cause : report.causes)
    for (const CompetitorsOf<Effect>& competing : competitors) {
      if (competing.selected.name() != cause.effect || competing.selected.joint != cause.joint) continue;
      std::vector<NamedEffect> others;
      for (const Effect& one : competing.others) others.push_back({std::string(one.name()), one.joint});
      report.ties.push_back(tieOf(cause, others, competing.probabilities));
    }
}

/// Verdict from the causes, ties, lines, explainable and explained shares of the report: a tie only if it is
/// that of the first cause. `residual`: whether the residual of the selected model is more than noise.
Verdict verdictOf(const Report& report, bool residual);

/// Report::summary without the uncertain effects: verdict, causes and ties in sentences.
std::string summaryOf(const Report& report);

/// Sentences about uncertain effects with their sizes, for the end of a summary: " Payload may be there, too
/// (probability 41 %): mass 0.021 ± 0.012 kg, moves …".
std::string uncertainText(const std::vector<Cause>& effects);

/// Fills verdict, causes, also_measurable, uncertain, ties, posterior, explained and summary of the report
/// from the selection; Report::material, explainable and lines are inputs. The σ of a cause's parameter
/// combines four parts: the σ of the fit; its spread over the kProbableSets most probable sets; 1 % of the
/// parameter, because laws are simplified; and half of the size that the effect has on a robot in good order
/// (Hypothesis::background).
void judge(const FitData& data, const Selection& selection, const robot::Description& robot, Report& report);

}  // namespace capstan::diagnosis
