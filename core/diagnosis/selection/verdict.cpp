#include "core/diagnosis/selection/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/fit/input_noise.h"
#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/selection/gains.h"

namespace capstan::diagnosis {
namespace {

constexpr double kFar = 4.0;  // times what may be chance: no test needed

/// Of the sensor, and of what those of loads and motors bring in.
double noiseSquare(const FitData& data, const Selection& s, Eigen::Index c) {
  const double sensor = data.channels()[static_cast<std::size_t>(c)].noise;
  return sensor * sensor + s.input_noise[c] * s.input_noise[c];
}

/// What a simplified law, the clock of the recording and the steps of an integration leave of a number at
/// best: a share of it.
constexpr double kLawsAreGood = 0.01;

/// Of "rad or m" what the joint goes by.
std::string unitAt(std::string_view unit, int joint, const robot::Description& robot) {
  constexpr std::string_view kOr = " or ";
  const std::size_t at = unit.find(kOr);
  if (joint == 0 || at == std::string_view::npos) return std::string(unit);
  const bool slides = robot.joints[static_cast<std::size_t>(joint - 1)].type == robot::JointType::kPrismatic;
  return std::string(slides ? unit.substr(at + kOr.size()) : unit.substr(0, at));
}

std::vector<FoundParameter> parametersOf(const FitModel& model, std::size_t effect, const Eigen::VectorXd& u,
                                         const Eigen::MatrixXd& covariance) {
  const EffectTerm& term = model.effects()[effect];
  const std::vector<double> values = model.effectValues(effect, u);
  const double background =
      term.joint > 0 ? term.hypothesis->background(scalesOf(model.scales(), term.joint)) : 0.0;
  const std::vector<double>& neutral = term.hypothesis->neutral;
  std::vector<FoundParameter> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& number = term.hypothesis->facts->parameters[i];
    double sigma = 0.0;
    if (const int at = term.index[i]; at >= 0)
      sigma =
          model.parameters()[static_cast<std::size_t>(at)].valueSigma(u[at], std::sqrt(covariance(at, at)));
    if (sigma > 0.0 && number.name != "time") sigma = std::hypot(sigma, kLawsAreGood * values[i]);
    if (neutral[i] == 0.0) sigma = std::hypot(sigma, 0.5 * background);  // a background effect
    found.push_back(
        {std::string(number.name), unitAt(number.unit, term.joint, model.nominal()), values[i], sigma});
  }
  return found;
}

std::string nameOf(const std::string& effect, int joint) {
  std::string title = titleOf(effect);
  return joint > 0 ? fmt::format("{} (joint {})", title, joint) : title;
}

std::string nameOf(const EffectCandidate& suspect) {
  return nameOf(std::string(suspect.hypothesis->name()), suspect.joint);
}

/// Where a cause shows: on the encoder of its joint if that gains, else where most is gained.
int channelOf(const FitData& data, const EffectCandidate& suspect, const BlockSquares& before,
              const BlockSquares& after) {
  for (std::size_t c = 0; c < data.channels().size() && suspect.joint > 0; ++c) {
    const auto row = static_cast<Eigen::Index>(c);
    if (data.channels()[c].joint == suspect.joint &&
        after.sum.row(row).sum() < 0.9 * before.sum.row(row).sum())
      return static_cast<int>(c);
  }
  return largestReduction(before, after).channel;
}

Cause causeOf(const FitData& data, const EffectCandidate& suspect, double probability,
              const BlockSquares& before, const BlockSquares& after, const Fit& fit,
              const Eigen::MatrixXd& covariance) {
  Cause cause;
  cause.effect = suspect.hypothesis->name();
  cause.joint = suspect.joint;
  cause.probability = probability;
  for (std::size_t k = 0; k < fit.model.effects().size(); ++k) {
    const EffectTerm& term = fit.model.effects()[k];
    if (!term.background && term.hypothesis == suspect.hypothesis && term.joint == suspect.joint)
      cause.parameters = parametersOf(fit.model, k, fit.u, covariance);
  }
  cause.gain = gainOf(data, before, after, channelOf(data, suspect, before, after));
  return cause;
}

/// Held-out segments are off by far more than noise though the fit leaves none: too little was seen for
/// what was fitted to hold elsewhere.
bool isTooShort(const FitData& data, const Selection& s) {
  for (Eigen::Index c = 0; c < s.best_squares.sum.rows(); ++c)
    if (s.best_squares.meanSquare(c) > kFar * mostByChance(data, s, c)) return true;
  return false;
}

std::string summaryOf(const Report& report, const Selection& s) {
  std::vector<std::string> names;
  for (const CandidateModel& c : s.taken) names.push_back(nameOf(c.added));
  switch (report.verdict) {
    case Verdict::kNothing:
      return "Nothing material: the refitted nominal robot explains the recording down to noise and what "
             "every "
             "robot has some of.";
    case Verdict::kUnexplained:
      return names.empty()
                 ? "Something is there that no hypothesis explains."
                 : fmt::format("Something is there that no hypothesis explains; {} takes off {:.0f} % of it.",
                               fmt::join(names, " and "), 100.0 * report.explained);
    case Verdict::kTie: {
      std::vector<std::string> tied;
      for (const Cause& cause : report.ties.front().causes) tied.push_back(nameOf(cause.effect, cause.joint));
      return fmt::format("This recording cannot distinguish {}.", fmt::join(tied, " and "));
    }
    default:
      return fmt::format("{} {} the recording ({:.0f} % of what is beyond noise).", fmt::join(names, " and "),
                         names.size() > 1 ? "explain" : "explains", 100.0 * report.explained);
  }
}

void addTies(const Selection& s, const FitData& data, const Eigen::MatrixXd& covariance, Report& report) {
  for (const CompetingExplanations& competitors : s.competitors) {
    if (competitors.others.empty()) continue;
    Tie tie;
    tie.causes.push_back(causeOf(data, competitors.taken, competitors.shares.front(), s.base_squares,
                                 s.best_squares, s.best, covariance));
    for (std::size_t k = 0; k < competitors.others.size(); ++k) {
      Cause cause;
      cause.effect = competitors.others[k].hypothesis->name();
      cause.joint = competitors.others[k].joint;
      cause.probability = competitors.shares[k + 1];
      tie.causes.push_back(std::move(cause));
    }
    tie.separate = fmt::format(
        "For {}: {} For {}: {}", nameOf(competitors.taken), competitors.taken.hypothesis->words.experiment,
        nameOf(competitors.others.front()), competitors.others.front().hypothesis->words.experiment);
    report.ties.push_back(std::move(tie));
  }
}

}  // namespace

double mostByChance(const FitData& data, const Selection& s, Eigen::Index c) {
  const double sensor = kBeyondNoise * data.channels()[static_cast<std::size_t>(c)].noise;
  return sensor * sensor + kSwings * s.input_noise[c] * s.input_noise[c];
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

bool hasResidual(const FitData& data, const Selection& s) {
  const BlockSquares left = squaresOf(data, s.best.e);
  for (Eigen::Index c = 0; c < left.sum.rows(); ++c)
    if (left.meanSquare(c) > mostByChance(data, s, c) &&
        (left.inflation[c] > 2.0 || left.meanSquare(c) > kFar * mostByChance(data, s, c)))
      return true;
  return false;
}

void judge(const FitData& data, const Selection& s, Report& report) {
  const Eigen::MatrixXd covariance = covarianceOf(data, s.best, s.weighting);
  report.explained = explainedShare(data, s);
  const BlockSquares* before = &s.base_squares;
  for (std::size_t k = 0; k < s.taken.size(); ++k) {
    const CandidateModel& c = s.taken[k];
    const BlockSquares& after = k + 1 == s.taken.size() ? s.best_squares : c.squares;
    report.causes.push_back(causeOf(data, c.added, c.share, *before, after, s.best, covariance));
    before = &after;
  }
  addTies(s, data, covariance, report);
  const bool left = !report.lines.empty() || hasResidual(data, s);
  const bool explains = !s.taken.empty() && (report.explained >= kExplains || !left);
  if (explains)
    report.verdict = !report.ties.empty() ? Verdict::kTie
                     : s.taken.size() > 1 ? Verdict::kSeveral
                                          : Verdict::kFound;
  else if (left)
    report.verdict = Verdict::kUnexplained;
  else
    report.verdict = Verdict::kNothing;
  report.summary = summaryOf(report, s);
  if (report.verdict == Verdict::kNothing && isTooShort(data, s))
    report.summary =
        "Too little motion to say: the refitted robot explains what it was fitted to, and not "
        "the held-out segments. Record 20 s or more with all joints in motion.";
}

}  // namespace capstan::diagnosis
