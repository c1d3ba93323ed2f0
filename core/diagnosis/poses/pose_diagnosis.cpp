#include "core/diagnosis/poses/pose_diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/error.h"
#include "core/diagnosis/poses/pose_channels.h"
#include "core/diagnosis/poses/pose_explainable.h"
#include "core/diagnosis/poses/pose_selection.h"
#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/residuals/residual_process.h"
#include "core/diagnosis/selection/gains.h"
#include "core/diagnosis/selection/verdict.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;

PoseReference referenceOf(const PoseEvidence& evidence, const PoseOptions& options) {
  if (options.towards) return *options.towards;
  return evidence.robot.rows > 0 ? PoseReference::kKinematics : PoseReference::kCommand;
}

std::vector<PoseHypothesis> chosen(std::vector<PoseHypothesis> all, const std::vector<std::string>& only) {
  if (only.empty()) return all;
  std::vector<PoseHypothesis> some;
  for (const std::string& name : only) {
    const auto found = std::ranges::find(all, name, &PoseHypothesis::name);
    if (found != all.end()) {
      if (std::ranges::find(some, name, &PoseHypothesis::name) == some.end()) some.push_back(*found);
      continue;
    }
    std::string names;
    for (const PoseHypothesis& one : all) names += (names.empty() ? "" : ", ") + std::string(one.name);
    throw base::InputError(
        {"", 0, "only", name, "is no effect that these poses can show", "Effects: " + names});
  }
  return some;
}

class Work {
 public:
  Work(const PoseEvidence& evidence, const PoseOptions& options, PoseReport& result)
      : options_(options), result_(result), report_(result.report), fitted_({}), held_out_({}) {
    result.towards = referenceOf(evidence, options);
    report_.material = options.material;
    std::vector<PoseMotion> motions = motionsOf(evidence, result.towards), fitted, held_out;
    for (std::size_t k = 0; k < motions.size(); ++k)
      (k % kHeldOut == kHeldOut - 1 ? held_out : fitted).push_back(std::move(motions[k]));
    fitted_ = PoseData(std::move(fitted));
    held_out_ = PoseData(std::move(held_out));
    result.fitted = fitted_.motions().size();
    result.held_out = held_out_.motions().size();
    effects_ = chosen(poseHypotheses(result.towards, evidence.turns), options.only);
  }

  void run(base::Progress* progress) {
    selection_ = selectPoses(fitted_, effects_, options_.seed, progress);
    report_.candidates = selection_.candidates;
    report_.posterior = selection_.posterior;
    lap("select");
    addSteps(progress);
    noise_ = noiseOf(held_out_, residuals_.back());
    if (progress) progress->report(kProgressOfSearch, "Fitting a regression to the residual");
    if (options_.show || hasResidual())
      report_.explainable = explainableOf(fitted_, selection_.base.e,
                                          diagnosis::heldOut(fitted_, selection_.best), noise_, progress);
    lap("explainable");
    addCauses();
    addChannels();
    judge();
    lap("judge");
    if (options_.show && hasResidual()) addProcess(progress);
    lap("show");
  }

  void addRobots(const robot::Description& nominal) {
    report_.refitted = report_.extended = nominal;
    if (result_.towards != PoseReference::kKinematics) return;
    for (const auto* causes : {&report_.causes, &report_.also_measurable})
      for (const Cause& cause : *causes) {
        if (!robot::effectNamed(cause.effect)) continue;
        robot::Effect effect{cause.effect, cause.joint, {}};
        for (const FoundParameter& one : cause.parameters) effect.values.push_back({one.name, one.value});
        report_.extended.effects.push_back(std::move(effect));
      }
  }

 private:
  void lap(const char* name) {
    const auto now = std::chrono::steady_clock::now();
    report_.stages.push_back({name, std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }

  Matrix3Xd heldOut(const PoseFit& fit) const {
    return residualOf(held_out_, numbersOf(fit.effects, fit.value));
  }

  void addStep(const PoseFit& fit, const std::string& effect) {
    const Matrix3Xd e = heldOut(fit);
    const BlockSquares squares = squaresOf(held_out_, e);
    BlockSquares together{squares.sum.colwise().sum(), squares.count.row(0), {}};
    const Gain gain = gainOf(ComparedChannel{}, together, together, 0);
    PoseStep step{effect, gain.rms_after, gain.after, {}, 0.0};
    for (Index axis = 0; axis < 3; ++axis)
      step.axis[static_cast<std::size_t>(axis)] =
          std::sqrt(squares.sum.row(axis).sum() / squares.count.row(axis).sum());
    const Eigen::VectorXd distance = e.colwise().norm();
    step.median = stats::median({distance.data(), static_cast<std::size_t>(distance.size())});
    result_.steps.push_back(step);
    residuals_.push_back(e);
    squares_.push_back(squares);
  }

  /// Adds a step for each effect; the effects added before are refitted each time.
  void addSteps(const base::Progress* progress) {
    PoseFit fit = selection_.base;
    addStep(fit, {});
    for (const SelectedOf<PoseEffect>& one : selection_.effects) {
      if (progress && progress->cancelled()) return;
      const bool last = &one == &selection_.effects.back();
      fit = last ? selection_.best : with(fitted_, fit, *one.effect.hypothesis);
      addStep(fit, std::string(one.effect.name()));
    }
  }

  /// Effect of a fit: parameters and displacement.
  Cause sizeOf(const PoseFit& fit, const PoseHypothesis& effect, double probability,
               const Eigen::MatrixXd& covariance) const {
    Cause cause;
    cause.effect = effect.name;
    cause.probability = probability;
    const Index place = fit.placeOf(effect.name);
    for (std::size_t i = 0; i < effect.size(); ++i) {
      const Index at = place + static_cast<Index>(i);
      const robot::EffectParameter& parameter = (*effect.parameters)[i];
      cause.parameters.push_back({std::string(parameter.name), std::string(parameter.unit), fit.value[at],
                                  withLawError(std::sqrt(covariance(at, at)), fit.value[at])});
    }
    cause.moves.tip = displacementBy(fit, effect);
    return cause;
  }

  Cause causeOf(const SelectedOf<PoseEffect>& selected, const Eigen::MatrixXd& covariance) const {
    Cause cause = sizeOf(selection_.best, *selected.effect.hypothesis, selected.probability, covariance);
    cause.loss = selected.loss;
    const int axis = largestReduction(selected.without, selection_.best_squares).channel;
    cause.gain = gainOf(comparedChannel(axis, noise_), selected.without, selection_.best_squares, axis);
    return cause;
  }

  /// Displacement of the measured tip by the effect; all other parameters are equal.
  Displacement displacementBy(const PoseFit& fit, const PoseHypothesis& effect) const {
    Eigen::VectorXd less = fit.value;
    less.segment(fit.placeOf(effect.name), static_cast<Index>(effect.size())).setZero();
    const Eigen::VectorXd moved =
        (residualOf(fitted_, numbersOf(fit.effects, less)) - fit.e).colwise().norm();
    return {std::sqrt(moved.squaredNorm() / static_cast<double>(std::max<Index>(1, moved.size()))),
            moved.size() > 0 ? moved.maxCoeff() : 0.0, true};
  }

  void addCauses() {
    const Eigen::MatrixXd covariance = covarianceOf(fitted_, selection_.best);
    for (const SelectedOf<PoseEffect>& one : selection_.effects)
      addCause(causeOf(one, covariance), one.without, selection_.best_squares, report_);
    addTies(selection_.competitors, report_);
    if (selection_.uncertain.empty()) return;
    const Eigen::MatrixXd of_most_probable = covarianceOf(fitted_, selection_.most_probable);
    for (const UncertainOf<PoseEffect>& one : selection_.uncertain)
      report_.uncertain.push_back(
          sizeOf(selection_.most_probable, *one.effect.hypothesis, one.probability, of_most_probable));
  }

  void addChannels() {
    const Matrix3Xd &before = residuals_.front(), &after = residuals_.back();
    variables_ = poseVariables(held_out_);
    for (int axis = 0; axis < 3; ++axis) {
      ChannelReport channel;
      channel.nominal = channel.refitted = poseChannel(held_out_, before, axis, noise_);
      channel.extended = poseChannel(held_out_, after, axis, noise_);
      channel.nominal_statistics = channel.refitted_statistics = statisticsOf(channel.refitted);
      channel.extended_statistics = statisticsOf(channel.extended);
      if (options_.show) {
        channel.before = strongestFirst(signaturesOf(channel.refitted, variables_));
        channel.after = strongestFirst(signaturesOf(channel.extended, variables_));
      }
      channel.gain = gainOf(comparedChannel(axis, noise_), squares_.front(), squares_.back(), axis);
      report_.channels.push_back(std::move(channel));
    }
  }

  static std::vector<Signature> strongestFirst(std::vector<Signature> signatures) {
    std::ranges::stable_sort(signatures, std::greater<>(), &Signature::share);
    return signatures;
  }

  /// True if the residual of some axis exceeds noise and tolerance, and is correlated from observation to
  /// observation.
  bool hasResidual() const {
    const double material = options_.material.length * options_.material.length;
    for (Index axis = 0; axis < 3; ++axis)
      if (squares_.back().meanSquare(axis) > std::pow(kBeyondNoise * noise_[axis], 2.0) + material &&
          squares_.back().inflation[axis] > 2.0)
        return true;
    return false;
  }

  double explained() const {
    double before = 0.0, after = 0.0;
    for (Index axis = 0; axis < 3; ++axis) {
      const double noise = noise_[axis] * noise_[axis];
      before += std::max(0.0, squares_.front().meanSquare(axis) - noise);
      after += std::max(0.0, squares_.back().meanSquare(axis) - noise);
    }
    return before > 0.0 ? std::clamp(1.0 - after / before, 0.0, 1.0) : 0.0;
  }

  void judge() {
    report_.explained = selection_.effects.empty() ? 0.0 : explained();
    report_.verdict = verdictOf(report_, hasResidual());
    report_.summary = summary() + uncertainText(report_.uncertain);
  }

  std::string summary() const {
    const std::string reference = result_.towards == PoseReference::kKinematics
                                      ? "the robot's kinematics report"
                                      : "the command asks for";
    if (report_.verdict == Verdict::kNothing)
      return report_.also_measurable.empty()
                 ? "Nothing material: the cameras agree with what " + reference + ", down to noise."
                 : fmt::format("Nothing material: {} can be measured and is below the tolerance.",
                               causeNames(report_.also_measurable));
    std::string text = fmt::format("On held-out trajectories the tip is {:.2f} mm (RMS) from where {}",
                                   1e3 * result_.steps.front().rms, reference);
    if (result_.steps.size() > 1)
      text += fmt::format(", and {:.2f} mm with the effects of the model", 1e3 * result_.steps.back().rms);
    text += ".";
    if (!report_.causes.empty()) text += fmt::format(" Causes: {}.", causeNames(report_.causes));
    for (const Tie& tie : report_.ties)
      text += fmt::format(" The table cannot distinguish {}.", causeNames(mostProbableFirst(tie)));
    if (report_.verdict == Verdict::kUnexplained) text += " No hypothesis explains the rest.";
    return text;
  }

  void addProcess(base::Progress* progress) {
    if (progress) progress->report(0.9, "Asking what the residual depends on");
    const auto beyond = [this](const ChannelReport& channel) {
      return channel.extended_statistics.rms / std::max(noise_[channel.extended.axis], 1e-12);
    };
    const auto most = std::ranges::max_element(report_.channels, {}, beyond);
    report_.processes.push_back(residualProcess(most->extended, variables_, {}, progress));
  }

  const PoseOptions& options_;
  PoseReport& result_;
  Report& report_;
  PoseData fitted_, held_out_;
  std::vector<PoseHypothesis> effects_;
  PoseSelection selection_;
  std::vector<Matrix3Xd> residuals_;  ///< of each step, held out
  std::vector<BlockSquares> squares_;
  Eigen::Vector3d noise_ = Eigen::Vector3d::Zero();
  std::vector<Variable> variables_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

PoseReport diagnosePoses(const PoseEvidence& evidence, const robot::Description& nominal,
                         const PoseOptions& options, base::Progress* progress) {
  PoseReport result;
  Work work(evidence, options, result);
  result.report.recordings = {evidence.title};
  result.report.notices = evidence.notices;
  work.run(progress);
  work.addRobots(nominal);
  result.report.cancelled = progress && progress->cancelled();
  return result;
}

}  // namespace capstan::diagnosis
