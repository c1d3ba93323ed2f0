#include "core/diagnosis/selection/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/diagnosis/fit/input_noise.h"
#include "core/diagnosis/hypotheses/pose_hypotheses.h"
#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "core/diagnosis/selection/displacement.h"
#include "core/diagnosis/selection/explainable.h"
#include "core/diagnosis/selection/gains.h"

namespace capstan::diagnosis {
namespace {

constexpr double kFar = 4.0;  // times what may be chance: no test needed

/// Mean square of the noise of the simulation's inputs, and of torques between the rows.
double inputSquare(const Selection& s, Eigen::Index c) {
  return s.input_noise.rms[c] * s.input_noise.rms[c] + s.torque_noise.rms[c] * s.torque_noise.rms[c];
}

/// Mean square of all noise of a channel. Of torques between the rows, whose noise is known by its upper
/// bound only, it is at most what the effects leave.
double noiseSquare(const FitData& data, const Selection& s, Eigen::Index c) {
  const double sensor = data.channels()[static_cast<std::size_t>(c)].noise;
  const double known = sensor * sensor + s.input_noise.rms[c] * s.input_noise.rms[c];
  const double left = std::max(0.0, s.best_squares.meanSquare(c) - known);
  return known + std::min(s.torque_noise.rms[c] * s.torque_noise.rms[c], left);
}

/// Of "rad or m" what the joint goes by.
std::string unitAt(std::string_view unit, int joint, const robot::Description& robot) {
  constexpr std::string_view kOr = " or ";
  const std::size_t at = unit.find(kOr);
  if (joint == 0 || at == std::string_view::npos) return std::string(unit);
  const bool slides = robot.joints[static_cast<std::size_t>(joint - 1)].type == robot::JointType::kPrismatic;
  return std::string(slides ? unit.substr(at + kOr.size()) : unit.substr(0, at));
}

/// FoundParameter::joint_per_length of a parameter. Effects of a cable drive with a unit of length are
/// lengths of the joint's cable.
double jointPerLength(std::string_view unit, const EffectTerm& term, const robot::Description& robot) {
  if (unit != "m" || term.joint == 0 || robot.drive != robot::DriveType::kCable) return 0.0;
  const auto j = static_cast<std::size_t>(term.joint - 1);
  return robot.joints[j].type == robot::JointType::kPrismatic ? 0.0 : 1.0 / robot.drives[j].link_radius;
}

std::vector<FoundParameter> parametersOf(const Fit& fit, std::size_t effect,
                                         const Eigen::MatrixXd& covariance) {
  const FitModel& model = fit.model;
  const EffectTerm& term = model.effects()[effect];
  const std::vector<double> values = model.effectValues(effect, fit.u);
  const double background =
      term.joint > 0 ? term.hypothesis->background(scalesOf(model.scales(), term.joint)) : 0.0;
  const std::vector<double>& neutral = term.hypothesis->neutral;
  std::vector<FoundParameter> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& number = term.hypothesis->facts->parameters[i];
    double sigma = 0.0;
    const int at = term.index[i];
    if (at >= 0) {
      const FitParameter& parameter = model.parameters()[static_cast<std::size_t>(at)];
      sigma = parameter.valueSigma(fit.u[at], std::sqrt(covariance(at, at)));
    }
    if (sigma > 0.0 && !isEventTime(number)) sigma = withLawError(sigma, values[i]);
    if (neutral[i] == 0.0) sigma = std::hypot(sigma, 0.5 * background);  // a background effect
    found.push_back({std::string(number.name), unitAt(number.unit, term.joint, model.nominal()), values[i],
                     sigma, jointPerLength(number.unit, term, model.nominal()),
                     at >= 0 && !fit.bound.empty() && fit.bound[static_cast<std::size_t>(at)]});
  }
  return found;
}

/// Index in FitModel::effects(); empty: the model does not have the effect as a cause.
std::optional<std::size_t> indexOf(const FitModel& model, const EffectCandidate& effect) {
  for (std::size_t k = 0; k < model.effects().size(); ++k) {
    const EffectTerm& term = model.effects()[k];
    if (!term.background && term.hypothesis == effect.hypothesis && term.joint == effect.joint) return k;
  }
  return std::nullopt;
}

/// Whether the numbers of `term` that are not fitted have these values.
bool hasFixedNumbers(const EffectTerm& term, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (term.index[i] < 0 && term.start.value[i] != values[i]) return false;
  return true;
}

/// Adds to the σ of each fitted number its spread over the most probable sets with the effect (Hoeting,
/// Madigan, Raftery and Volinsky, Bayesian model averaging, Statistical Science 14, 1999): the fit of one set
/// does not know what other effects would have taken of it.
void addSpread(const Selection& s, const EffectTerm& term, std::vector<FoundParameter>& parameters) {
  double probability = 0.0;
  std::vector<double> variance(parameters.size(), 0.0);
  for (const ProbableSet& one : s.probable) {
    const std::optional<std::size_t> index = indexOf(one.set.fit.model, {term.hypothesis, term.joint});
    if (!index) continue;
    const std::vector<double> values = one.set.fit.model.effectValues(*index, one.set.fit.u);
    if (!hasFixedNumbers(term, values)) continue;  // of another cable, for example
    probability += one.probability;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      variance[i] += one.probability * std::pow(values[i] - parameters[i].value, 2);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (term.index[i] >= 0 && probability > 0.0)
      parameters[i].sigma = std::hypot(parameters[i].sigma, std::sqrt(variance[i] / probability));
}

std::string nameOf(const std::string& effect, int joint) {
  std::string title = titleOf(effect);
  return joint > 0 ? fmt::format("{} (joint {})", title, joint) : title;
}

/// Channel that shows a cause: the encoder of its joint if that gains, else the one that gains most.
int channelOf(const FitData& data, const EffectCandidate& effect, const BlockSquares& without,
              const BlockSquares& with) {
  constexpr double kGains = 0.9;
  for (std::size_t c = 0; c < data.channels().size() && effect.joint > 0; ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    if (data.channels()[c].joint == effect.joint &&
        with.sum.row(row).sum() < kGains * without.sum.row(row).sum())
      return static_cast<int>(c);
  }
  return largestReduction(without, with).channel;
}

/// Effect of a fit: parameters and displacement.
Cause sizeOf(const FitData& data, const Selection& s, const Fit& fit, const EffectCandidate& effect,
             double probability, const Eigen::MatrixXd& covariance, const robot::Description& robot) {
  Cause cause;
  cause.effect = effect.hypothesis->name();
  cause.joint = effect.joint;
  cause.probability = probability;
  if (const std::optional<std::size_t> index = indexOf(fit.model, effect)) {
    cause.parameters = parametersOf(fit, *index, covariance);
    addSpread(s, fit.model.effects()[*index], cause.parameters);
  }
  cause.moves = displacementsBy(data, fit, effect, robot);
  return cause;
}

/// Uncertain effects with the numbers of the most probable set.
std::vector<Cause> uncertainOf(const FitData& data, const Selection& s, const robot::Description& robot) {
  std::vector<Cause> causes;
  if (s.uncertain.empty() || s.probable.empty()) return causes;
  SetFit most_probable = s.probable.front().set;
  SetFitter(data).relinearise(most_probable);
  const Eigen::MatrixXd covariance = covarianceOf(data, most_probable.fit, most_probable.weighting);
  for (const UncertainEffect& one : s.uncertain)
    causes.push_back(sizeOf(data, s, most_probable.fit, one.effect, one.probability, covariance, robot));
  return causes;
}

Cause causeOf(const FitData& data, const Selection& s, const SelectedEffect& selected,
              const Eigen::MatrixXd& covariance, const robot::Description& robot) {
  const EffectCandidate& effect = selected.effect;
  Cause cause = sizeOf(data, s, s.best, effect, selected.probability, covariance, robot);
  cause.loss = selected.loss;
  cause.gain = gainOf(data, selected.without, s.best_squares,
                      channelOf(data, effect, selected.without, s.best_squares));
  return cause;
}

/// Held-out segments are off by far more than noise though the fit leaves none: too little was seen for
/// what was fitted to hold elsewhere.
bool isTooShort(const FitData& data, const Selection& s) {
  for (Eigen::Index c = 0; c < s.best_squares.sum.rows(); ++c)
    if (s.best_squares.meanSquare(c) > kFar * mostByChance(data, s, c)) return true;
  return false;
}

std::string verdictText(const Report& report) {
  const double percent = 100.0 * report.explained;
  switch (report.verdict) {
    case Verdict::kNothing:
      return report.also_measurable.empty()
                 ? "Nothing material: the refitted nominal robot explains the recording down to noise."
                 : fmt::format("Nothing material: {} can be measured and is below the tolerance.",
                               causeNames(report.also_measurable));
    case Verdict::kUnexplained:
      return report.causes.empty()
                 ? "Something is there that no hypothesis explains."
                 : fmt::format("Something is there that no hypothesis explains; {} takes off {:.0f} % of it.",
                               causeNames(report.causes), percent);
    case Verdict::kTie: {
      std::vector<Cause> others = report.causes;
      std::erase_if(others, [&](const Cause& cause) { return tieOfCause(report, cause); });
      return fmt::format("This recording cannot distinguish {}.{}",
                         causeNames(mostProbableFirst(report.ties.front())),
                         others.empty() ? "" : fmt::format(" There as well: {}.", causeNames(others)));
    }
    default:
      return fmt::format("{} {} the recording ({:.0f} % of what is beyond noise).", causeNames(report.causes),
                         report.causes.size() > 1 ? "explain" : "explains", percent);
  }
}

/// Sentences about ties that verdictText() does not name.
std::string otherTiesText(const Report& report) {
  std::string text;
  for (std::size_t k = report.verdict == Verdict::kTie ? 1 : 0; k < report.ties.size(); ++k)
    text += fmt::format(" {} cannot be distinguished.", causeNames(mostProbableFirst(report.ties[k])));
  return text;
}

std::string experimentFor(const NamedEffect& effect) {
  return fmt::format("For {}: {}", nameOf(effect.effect, effect.joint), wordsOf(effect.effect)->experiment);
}

}  // namespace

double mostByChance(const FitData& data, const Selection& s, Eigen::Index c) {
  const double sensor = kBeyondNoise * data.channels()[static_cast<std::size_t>(c)].noise;
  return sensor * sensor + kSwings * inputSquare(s, c);
}

double explainedShare(const FitData& data, const Selection& s) {
  double most = 0.0, share = 0.0;
  for (Eigen::Index c = 0; c < s.base_squares.sum.rows(); ++c) {
    const double noise = noiseSquare(data, s, c), before = s.base_squares.meanSquare(c) - noise;
    const double beyond = noise > 0.0 ? before / noise : before;
    if (!(beyond > most)) continue;
    most = beyond;
    share = 1.0 - std::max(0.0, s.best_squares.meanSquare(c) - noise) / before;
  }
  return std::clamp(share, 0.0, 1.0);
}

bool hasResidual(const FitData& data, const Selection& s, const Tolerance& tolerance) {
  const BlockSquares left = squaresOf(data, s.best.e);
  for (Eigen::Index c = 0; c < left.sum.rows(); ++c) {
    const bool angle = data.channels()[static_cast<std::size_t>(c)].unit == "rad";
    const double chance = mostByChance(data, s, c), most = angle ? tolerance.angle : tolerance.length;
    if (left.meanSquare(c) < chance + most * most) continue;
    if (left.inflation[c] > 2.0 || left.meanSquare(c) > kFar * chance) return true;
  }
  return false;
}

std::string causeNames(const std::vector<Cause>& causes) {
  std::vector<std::string> names;
  for (const Cause& cause : causes) names.push_back(nameOf(cause.effect, cause.joint));
  return fmt::format("{}", fmt::join(names, " and "));
}

double withLawError(double sigma, double value) { return std::hypot(sigma, kLawError * value); }

void addCause(Cause cause, const BlockSquares& without, const BlockSquares& with, Report& report) {
  const bool material =
      isMaterial(cause.moves, report.material) && largestReduction(without, with).share > kMaterialShare;
  (material ? report.causes : report.also_measurable).push_back(std::move(cause));
}

Tie tieOf(const Cause& cause, const std::vector<NamedEffect>& others,
          const std::vector<double>& probabilities) {
  Tie tie;
  tie.causes.push_back(cause);
  tie.causes.front().probability = probabilities.front();
  for (std::size_t k = 0; k < others.size(); ++k) {
    Cause other;
    other.effect = others[k].effect;
    other.joint = others[k].joint;
    other.probability = probabilities[k + 1];
    tie.causes.push_back(std::move(other));
  }
  tie.separate = experimentFor({cause.effect, cause.joint});
  std::set<std::string> effects{cause.effect};  // at another joint the same experiment
  for (const NamedEffect& other : others)
    if (effects.insert(other.effect).second) tie.separate += " " + experimentFor(other);
  return tie;
}

Verdict verdictOf(const Report& report, bool residual) {
  const bool regression_better = residual && fallsShort(report.explainable, report.material);
  const bool unexplained =
      !report.lines.empty() || regression_better || (residual && !isAllThatCanBe(report.explainable));
  if (report.causes.empty() || (unexplained && (report.explained < kExplains || regression_better)))
    return unexplained ? Verdict::kUnexplained : Verdict::kNothing;
  if (tieOfCause(report, report.causes.front())) return Verdict::kTie;
  return report.causes.size() > 1 ? Verdict::kSeveral : Verdict::kFound;
}

std::string summaryOf(const Report& report) { return verdictText(report) + otherTiesText(report); }

std::string uncertainText(const std::vector<Cause>& effects) {
  std::string text;
  for (const Cause& one : effects) {
    text += fmt::format(" {} may be there, too (probability {:.0f} %)", nameOf(one.effect, one.joint),
                        100.0 * one.probability);
    for (const FoundParameter& parameter : one.parameters)
      text += (&parameter == &one.parameters.front() ? ": " : ", ") + shownParameter(one.effect, parameter);
    text += (one.parameters.empty() ? ": " : "; ") + movesText(one) + ".";
  }
  return text;
}

void judge(const FitData& data, const Selection& s, const robot::Description& robot, Report& report) {
  const Eigen::MatrixXd covariance = covarianceOf(data, s.best, s.weighting);
  report.explained = explainedShare(data, s);
  report.posterior = s.posterior;
  for (const SelectedEffect& selected : s.effects)
    addCause(causeOf(data, s, selected, covariance, robot), selected.without, s.best_squares, report);
  addTies(s.competitors, report);
  report.uncertain = uncertainOf(data, s, robot);
  report.verdict = verdictOf(report, hasResidual(data, s, report.material));
  report.summary = summaryOf(report) + uncertainText(report.uncertain);
  if (report.verdict == Verdict::kNothing && isTooShort(data, s))
    report.summary =
        "Too little motion to say: the refitted robot explains what it was fitted to, and not "
        "the held-out segments. Record 20 s or more with all joints in motion.";
}

}  // namespace capstan::diagnosis
