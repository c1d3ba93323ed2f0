#include "core/diagnosis/selection/screening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLittle = 0.1;    // of a size that would be large
constexpr double kFarthest = 3.0;  // of it, where a refit may start
constexpr double kOwn = 1e-6;      // share of a response that the fit cannot make itself: less is none

/// One start of one candidate and its columns among the responses.
struct Probe {
  EffectCandidate suspect;
  EffectStart start;
  std::vector<std::size_t> numbers;  ///< that move; empty: the effect as a whole
  std::size_t column = 0;
  double from = -1.0;  ///< an event's time: the response counts from then on [s]; negative: no event
};

/// Numbers whose neutral value is 0 and that the start leaves there: small ones can be tried both ways.
std::vector<std::size_t> smallNumbers(const Hypothesis& hypothesis, const EffectStart& start) {
  const std::vector<double>& neutral = hypothesis.neutral;
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < neutral.size(); ++k)
    if (neutral[k] == 0.0 && start.scale[k] > 0.0 && start.value[k] == 0.0) numbers.push_back(k);
  return numbers;
}

int timeOf(const Hypothesis& hypothesis) {
  const auto& numbers = hypothesis.facts->parameters;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (isEventTime(numbers[k])) return static_cast<int>(k);
  return -1;
}

robot::ChainModel with(const Fit& fit, const EffectCandidate& suspect, const EffectStart& start) {
  const FitModel model = fit.model.with(*suspect.hypothesis, suspect.joint, start);
  return model.chain(model.startFrom(fit.model, fit.u));
}

/// Numbers that the fit has of the effect as an background one: what small changes go out from.
std::vector<double> backgroundValues(const Fit& fit, const EffectCandidate& suspect) {
  for (std::size_t k = 0; k < fit.model.effects().size(); ++k) {
    const EffectTerm& term = fit.model.effects()[k];
    if (term.background && term.hypothesis == suspect.hypothesis && term.joint == suspect.joint)
      return fit.model.effectValues(k, fit.u);
  }
  return std::vector<double>(suspect.hypothesis->neutral.size(), 0.0);
}

/// Probes of a candidate; their robots are appended.
void addProbes(const Fit& fit, const EffectCandidate& suspect, std::vector<Probe>& probes,
               std::vector<robot::ChainModel>& robots) {
  const JointScales& scales = scalesOf(fit.model.scales(), suspect.joint);
  const int time = timeOf(*suspect.hypothesis);
  const std::vector<double> background = backgroundValues(fit, suspect);
  for (const EffectStart& start : suspect.hypothesis->starts(scales, suspect.joint)) {
    Probe probe{suspect, start, smallNumbers(*suspect.hypothesis, start), robots.size(), -1.0};
    if (time >= 0) probe.start.value[static_cast<std::size_t>(time)] = 0.0;
    for (const std::size_t number : probe.numbers) probe.start.value[number] = background[number];
    if (probe.numbers.empty()) robots.push_back(with(fit, suspect, probe.start));
    for (const std::size_t number : probe.numbers) {
      EffectStart little = probe.start;
      little.value[number] += kLittle * little.scale[number];
      robots.push_back(with(fit, suspect, little));
    }
    if (time < 0) {
      probes.push_back(probe);
      continue;
    }
    const auto [first, last] = eventTimes(scales);
    for (double from = first; from <= last; from += kEventStep) {
      probe.from = from;
      probe.start.value[static_cast<std::size_t>(time)] = from;
      probes.push_back(probe);
    }
    break;  // one response serves all instants
  }
}

/// The fit's objective, misfit and priors, around the fit: residual and responses are weighted, and the fit's
/// own free parameters follow.
class Projection {
 public:
  Projection(const Fit& fit, const Weighting& weighting)
      : u_(fit.u), precision_(priorPrecision(fit.model)), weights_(weighting.weights) {
    for (Index k = 0; k < fit.u.size(); ++k)
      if (fit.bound.empty() || !fit.bound[static_cast<std::size_t>(k)]) free_.push_back(k);
    parameters_ = fit.u.size();
    jacobian_ = weights_.asDiagonal() * fit.jacobian(Eigen::all, free_);
    MatrixXd normal = jacobian_.transpose() * jacobian_;
    normal.diagonal() += precision_(free_);
    normal_ = normal.ldlt();
    e_ = weights_.cwiseProduct(fit.e);
    slope_ = jacobian_.transpose() * e_ - precision_.cwiseProduct(u_)(free_);
  }

  const VectorXd& weights() const { return weights_; }

  /// Sizes of the columns d (weighted) that take most off the objective, and how much they take.
  std::pair<VectorXd, double> best(const MatrixXd& d) const {
    const auto [s, g] = ownDirections(d);
    std::vector<Index> seen;  // not those that the fit's own numbers could make as well
    for (Index k = 0; k < s.rows(); ++k)
      if (s(k, k) > kOwn * d.col(k).squaredNorm()) seen.push_back(k);
    VectorXd size = VectorXd::Zero(g.size());
    if (seen.empty()) return {size, 0.0};
    MatrixXd seen_s = s(seen, seen);
    seen_s.diagonal() *= 1.0 + 1e-9;
    const VectorXd solved = seen_s.ldlt().solve(g(seen));
    for (std::size_t k = 0; k < seen.size(); ++k) size[seen[k]] = solved[static_cast<Index>(k)];
    return {size, 2.0 * size.dot(g) - size.dot(s * size)};
  }
  /// What given sizes would take off the objective.
  double gain(const MatrixXd& d, const VectorXd& size) const {
    const auto [s, g] = ownDirections(d);
    return 2.0 * size.dot(g) - size.dot(s * size);
  }
  /// What given sizes would take off the misfit, as a share of it.
  double share(const MatrixXd& d, const VectorXd& size) const {
    const VectorXd change = follow(d, size);
    const VectorXd left = e_ - d * size - jacobian_ * change(free_);
    return 1.0 - left.squaredNorm() / e_.squaredNorm();
  }
  /// What given sizes would take off the priors of the fit's parameters, which return towards the nominal
  /// ones [nats].
  double prior(const MatrixXd& d, const VectorXd& size) const {
    const VectorXd after = u_ + follow(d, size);
    return 0.5 * (u_.cwiseAbs2() - after.cwiseAbs2()).dot(precision_);
  }
  /// Changes of the fit's parameters that go with sizes of the columns.
  VectorXd follow(const MatrixXd& d, const VectorXd& size) const {
    VectorXd change = VectorXd::Zero(parameters_);
    change(free_) = -normal_.solve(jacobian_.transpose() * (d * size));
    return change;
  }

 private:
  /// Curvature and slope of the objective along d, the fit's own numbers following.
  std::pair<MatrixXd, VectorXd> ownDirections(const MatrixXd& d) const {
    const MatrixXd own = jacobian_.transpose() * d;
    return {d.transpose() * d - own.transpose() * normal_.solve(own),
            d.transpose() * e_ - own.transpose() * normal_.solve(slope_)};
  }

  std::vector<Index> free_;
  Index parameters_ = 0;
  VectorXd u_, precision_, weights_, e_;
  VectorXd slope_;  ///< of the objective along the fit's own parameters, halved; 0 in its minimum
  MatrixXd jacobian_;
  Eigen::LDLT<MatrixXd> normal_;
};

/// Response columns of a probe, weighted; those of an event are zero before it.
MatrixXd columnsOf(const FitData& data, const Probe& probe, const MatrixXd& responses,
                   const VectorXd& weights) {
  const auto count = static_cast<Index>(std::max<std::size_t>(probe.numbers.size(), 1));
  MatrixXd d = weights.asDiagonal() * responses.middleCols(static_cast<Index>(probe.column), count);
  if (probe.from < 0.0) return d;
  for (int r = 0; r < data.recordings(); ++r) {
    const auto& t = data.simulation(r).compared().t;
    const double begin = data.simulation(r).evidence().t.front();
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t[i] - begin < probe.from) d.row(data.first(r) + static_cast<Index>(i)).setZero();
  }
  return d;
}

/// Simulated readings of each robot less those of the fit; diverging ones score nothing.
MatrixXd responsesOf(const FitData& data, const Fit& fit, const std::vector<robot::ChainModel>& robots,
                     const Weighting& weighting) {
  MatrixXd change = changesTo(data, fit, robots, weighting);
  for (Index k = 0; k < change.cols(); ++k)
    if (!change.col(k).allFinite()) change.col(k).setZero();
  return change;
}

/// The score_test of one probe.
ScoreTest judge(const Probe& probe, const Projection& projection, const MatrixXd& d) {
  auto [size, gain] = projection.best(d);
  const bool whole = probe.numbers.empty();
  const VectorXd before = size;
  for (Index k = 0; k < size.size(); ++k) {
    const double most = whole ? kFarthest : kFarthest / kLittle;
    const bool one_way =
        whole ||
        probe.suspect.hypothesis->facts->parameters[probe.numbers[static_cast<std::size_t>(k)]].low >= 0.0;
    size[k] = std::clamp(size[k], one_way ? 0.0 : -most, most);
  }
  if (size != before) gain = projection.gain(d, size);
  ScoreTest score_test{.hypothesis = probe.suspect.hypothesis,
                       .joint = probe.suspect.joint,
                       .start = probe.start,
                       .from = probe.start.value,
                       .follow = projection.follow(d, size),
                       .gain = std::max(gain, 0.0),
                       .share = std::max(projection.share(d, size), 0.0),
                       .prior = std::max(projection.prior(d, size), 0.0)};
  for (std::size_t k = 0; k < probe.numbers.size(); ++k) {
    const std::size_t number = probe.numbers[k];
    score_test.start.value[number] += kLittle * size[static_cast<Index>(k)] * score_test.start.scale[number];
  }
  if (whole && size.size() > 0 && probe.start.scale[0] > 0.0 && probe.start.value[0] > 0.0 &&
      probe.suspect.hypothesis->neutral[0] == 0.0) {
    score_test.start.value[0] *= std::clamp(size[0], 0.2, kFarthest);
    score_test.from = score_test.start.value;
  }
  return score_test;
}

/// Whether two starts of one candidate have the same values of the numbers that a fit leaves as they are,
/// such as the other joint of a coupling.
bool isOfOneFit(const ScoreTest& a, const ScoreTest& b) {
  if (a.hypothesis != b.hypothesis || a.joint != b.joint) return false;
  for (std::size_t k = 0; k < a.start.value.size(); ++k)
    if (a.start.scale[k] == 0.0 && b.start.scale[k] == 0.0 && a.start.value[k] != b.start.value[k])
      return false;
  return true;
}

/// A spring in series with a cable changes its k_e, which every model fits within a factor.
bool isStiffness(const EffectCandidate& effect, const FitModel& model) {
  return effect.hypothesis->name() == "cable_compliance" && !model.rigid() &&
         !isPracticallyRigid(scalesOf(model.scales(), effect.joint));
}

}  // namespace

std::vector<EffectCandidate> candidatesOf(const std::vector<Evidence>& recordings, const FitModel& model,
                                          const std::vector<std::string>& only) {
  const Evidence& first = recordings.front();
  const bool cameras =
      std::any_of(recordings.begin(), recordings.end(), [](const Evidence& e) { return e.hasCameras(); });
  std::vector<EffectCandidate> candidates;
  for (const Hypothesis& hypothesis : hypotheses()) {
    const robot::EffectFacts& facts = *hypothesis.facts;
    if (!(model.rigid() ? facts.rigid : facts.cable)) continue;
    if (!only.empty() && std::find(only.begin(), only.end(), facts.name) == only.end()) continue;
    const bool of_camera = facts.name.starts_with("camera_");
    if (of_camera && !cameras) continue;
    if (facts.name == "sensor_sign" && first.tau_ext.empty()) continue;
    for (int joint = facts.whole ? 0 : 1; joint <= (facts.whole ? 0 : first.joints); ++joint)
      if (!model.has(hypothesis, joint) && !isStiffness({&hypothesis, joint}, model))
        candidates.push_back({&hypothesis, joint});
  }
  return candidates;
}

std::vector<ScoreTest> screen(const FitData& data, const Fit& fit, const Weighting& weighting,
                              const std::vector<EffectCandidate>& candidates) {
  std::vector<Probe> probes;
  std::vector<robot::ChainModel> robots;
  for (const EffectCandidate& suspect : candidates) addProbes(fit, suspect, probes, robots);
  const MatrixXd response = responsesOf(data, fit, robots, weighting);
  const Projection projection(fit, weighting);
  std::vector<ScoreTest> score_tests;
  for (const Probe& probe : probes) {
    const MatrixXd d = columnsOf(data, probe, response, projection.weights());
    ScoreTest score_test = judge(probe, projection, d);
    const auto known = std::ranges::find_if(
        score_tests, [&](const ScoreTest& other) { return isOfOneFit(other, score_test); });
    if (known == score_tests.end())
      score_tests.push_back(std::move(score_test));
    else if (score_test.gain > known->gain)
      *known = std::move(score_test);
  }
  std::stable_sort(score_tests.begin(), score_tests.end(),
                   [](const ScoreTest& a, const ScoreTest& b) { return a.gain > b.gain; });
  return score_tests;
}

}  // namespace capstan::diagnosis
