#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/table.h"
#include "core/diagnosis/report/report.h"

/// Tables of a report for people, in degrees, millimetres and per cent (shown.h).
namespace capstan::diagnosis {

/// True if the model has effects: causes or effects that are also measurable.
bool hasEffects(const Report& report);
/// Title of the effect's hypothesis, "Backlash"; the effect's name if there is no such hypothesis.
std::string titleOf(std::string_view effect);
/// True for an effect of the cameras: its title names them.
bool namesItsPlace(std::string_view effect);
/// Title and place of an effect: "Backlash, joint 2"; the title alone if it names the place.
std::string titleAndPlace(const std::string& effect, int joint);
/// Cause in one line: "Backlash, joint 2: half width 0.930 ± 0.030 mm".
std::string causeText(const Cause& cause);
/// Reduction of a channel's RMS residual in one line: "q2: RMS 0.894 deg becomes 0.0251 deg, 2.8 % of it (95
/// %: 2.6 to 3.1 %), on data that were not fitted".
std::string gainText(const Gain& gain);

/// Causes of a tie, the most probable first.
std::vector<Cause> mostProbableFirst(const Tie& tie);
/// Tie of a cause of the report; null: it has none.
const Tie* tieOfCause(const Report& report, const Cause& cause);
/// Candidates in the order of the ranking: round by round, the most probable first; equally probable ones by
/// the score of their trial fit, and those without a trial fit last, by the predicted reduction.
std::vector<Candidate> rankedCandidates(const Report& report);
/// True if the model has the candidate: it is a cause or also measurable.
bool isInModel(const Report& report, const Candidate& candidate);
/// Probability of a candidate in per cent: "97", "< 1"; "–" if no model that was fitted until convergence has
/// it.
std::string candidatePercent(const Candidate& candidate);
/// Explanation of the ranking's columns.
std::string rankingNote();

/// Refitted parameters: those that are material first, then those that moved.
std::vector<RefitNumber> refitInOrder(const Report& report);
/// Change of a parameter: "−18.0 %", or the difference with its unit if it is larger than the nominal value.
std::string refitChange(const RefitNumber& number);
/// Whether a parameter moved, and how far its change alone moves the joint that it moves most: "material:
/// 0.041 deg at joint 2", "moved: 0.0031 deg at joint 2", "not moved".
std::string refitRemark(const RefitNumber& number, const Tolerance& tolerance);

/// Displacement by a cause in one line: "moves joint 2 by 0.41 deg RMS (largest 0.93 deg), the tip by 1.9 mm
/// RMS (largest 4.2 mm)". Joints that move by less than a tenth of the one that moves most are not named.
std::string movesText(const Cause& cause);
/// Displacement of the tip by the causes in one line: "Tip displacement: 1.90 mm RMS (largest 4.20 mm)."; for
/// several causes, or a tie, by each. Empty without causes that move the tip.
std::string tipText(const Report& report);
/// Heading of Report::also_measurable: "Also measurable, below the tolerance of 0.02deg,0.02mm or 6 % of
/// the mean square of a channel".
std::string alsoMeasurableTitle(const Report& report);
/// Explainable::share of a channel in one sentence. Empty if the report has no Explainable of this channel.
std::string explainedText(const Report& report, std::string_view channel);

/// One row per channel: RMS of measured − simulated with each of the three models, the sensor's noise, the
/// fit before and after, and the ratio of RMS after / before on held-out data with its 95 % interval. Columns
/// of the extended model appear only with causes, and the recording only if there are several.
base::Table channelTable(const Report& report);
/// Parameters of the nominal model before and after the refit, as refitInOrder(). If the model
/// has effects, the values refitted without and with them.
base::Table refitTable(const Report& report);
/// rankedCandidates(), at most `most` per round. The note gives the number of omitted hypotheses.
base::Table rankingTable(const Report& report, std::size_t most = 12);
/// RMS errors of the Kalman filter's joints with the three models; no rows if they were not requested.
base::Table filterTable(const Report& report);
/// One row per channel: RMS residual of the refitted model, of the model with its effects and of the
/// regressions, and Explainable::share.
base::Table explainableTable(const Report& report);
/// The most probable sets of effects, at most `most`; the set of the model is marked. The note gives the
/// probability of all others.
base::Table posteriorTable(const Report& report, std::size_t most = 12);
/// Significant lines in the residual's spectrum.
base::Table lineTable(const Report& report);
/// Variables that the residual depends on, by its Gaussian process: the most relevant one, and all others
/// with a relevance of at least kWeakly.
base::Table processTable(const ResidualProcess& process);

}  // namespace capstan::diagnosis
