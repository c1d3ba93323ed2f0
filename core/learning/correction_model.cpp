#include "core/learning/correction_model.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr Index kOutputs = 6;
constexpr double kFitShare = 0.7;  ///< of the time, for hyperparameters
constexpr const char* kLearningHyperparameters = "learning hyperparameters";

void checkEnough(std::size_t states) {
  if (states < kFewestStates)
    throw base::InputError({{},
                            0,
                            "states",
                            fmt::format("{}", states),
                            fmt::format("are too few to learn from; {} at least", kFewestStates),
                            "Record longer, or clean less"});
}

}  // namespace

CorrectionModel CorrectionModel::trained(const std::vector<State>& states, const CorrectionOptions& options,
                                         base::Progress* progress, const base::ProgressPart& part) {
  checkEnough(states.size());
  std::vector<PosePair> pairs;
  std::vector<Eigen::Isometry3d> moved;
  for (const State& state : states) pairs.push_back(state.pair);
  const Eigen::Isometry3d offset = rigidOffset(pairs, options.lever);
  for (const PosePair& pair : pairs) moved.push_back(offset * pair.seen);
  CorrectionModel model(offset, PoseFeatures(options.rotation, options.velocity, middleTurn(moved)));
  model.lever_ = options.lever;
  model.findScales(states);
  for (const Eigen::Isometry3d& pose : moved) model.workspace_.extend(pose.translation());
  const MatrixXd x = model.featuresOf(states), y = model.targetsOf(states);

  part.report(progress, 0.0, kLearningHyperparameters);
  const auto few = drawnPoints(x.rows(), options.likelihood_points, options.seed);
  const auto inducing = drawnPoints(x.rows(), options.inducing_points, options.seed + 1);
  const MatrixXd x_few = x(few, Eigen::all), x_inducing = x(inducing, Eigen::all);
  std::vector<ProcessFitReport> fits(kOutputs);
  std::atomic<int> fitted = 0;
  math::setDenseThreads(1);
  base::parallelFor(kOutputs, options.threads, [&](std::size_t k) {
    const MatrixXd y_few = y(few, Eigen::seqN(static_cast<Index>(k), 1));
    fits[k] = fitProcess(x_few, y_few, startOf(x_few, y_few, options.fit), options.fit, progress);
    part.report(progress, kFitShare * ++fitted / kOutputs, kLearningHyperparameters);
  });
  math::setDenseThreads(options.threads);
  for (Index k = 0; k < kOutputs && !(progress && progress->cancelled()); ++k) {
    part.report(progress, kFitShare + (1.0 - kFitShare) * static_cast<double>(k) / kOutputs,
                "learning all states");
    SparseProcess process(x_inducing, 1, fits[static_cast<std::size_t>(k)].parameters);
    process.add(x, y.col(k));
    model.processes_.push_back(std::move(process));
  }
  if (model.processes_.size() < kOutputs) model.processes_.clear();
  return model;
}

void CorrectionModel::findScales(const std::vector<State>& states) {
  middle_ = Eigen::RowVectorXd::Zero(features_.size());
  deviation_ = Eigen::RowVectorXd::Ones(features_.size());
  scale_ = Eigen::RowVectorXd::Ones(kOutputs);
  const auto orOne = [](double x) { return x > 1e-12 ? x : 1.0; };  // of what never changes
  const MatrixXd x = featuresOf(states), y = targetsOf(states);
  middle_ = x.colwise().mean();
  deviation_ = (x.rowwise() - middle_).array().square().colwise().mean().sqrt().matrix().unaryExpr(orOne);
  scale_ = y.array().square().colwise().mean().sqrt().matrix().unaryExpr(orOne);
}

Vector6d CorrectionModel::turnedVelocity(const Vector6d& velocity) const {
  Vector6d turned = velocity;  // the turn rate is in the tool's own frame
  turned.head<3>() = offset_.linear() * velocity.head<3>();
  return turned;
}

MatrixXd CorrectionModel::featuresOf(const std::vector<State>& states) const {
  MatrixXd x(static_cast<Index>(states.size()), features_.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    x.row(static_cast<Index>(k)) =
        features_.of(offset_ * states[k].pair.seen, turnedVelocity(states[k].velocity));
  return (x.rowwise() - middle_).array().rowwise() / deviation_.array();
}

MatrixXd CorrectionModel::targetsOf(const std::vector<State>& states) const {
  MatrixXd y(static_cast<Index>(states.size()), kOutputs);
  for (std::size_t k = 0; k < states.size(); ++k)
    y.row(static_cast<Index>(k)) =
        features_.correction(offset_ * states[k].pair.seen, states[k].pair.told).transpose();
  return y.array().rowwise() / scale_.array();
}

Corrected CorrectionModel::correct(const Eigen::Isometry3d& desired, const Vector6d& velocity) const {
  State state;
  state.pair.seen = desired;
  state.velocity = velocity;
  Corrected corrected{offset_ * desired, scale_.transpose(), 0.0};
  if (processes_.empty()) return corrected;
  const MatrixXd x = featuresOf({state});
  Vector6d correction;
  double left = 0.0, all = 0.0;
  for (Index k = 0; k < kOutputs; ++k) {
    const SparseProcess& process = processes_[static_cast<std::size_t>(k)];
    const Prediction told = process.predict(x);
    const RbfParameters& p = process.parameters();
    correction[k] = scale_[k] * told.mean(0, 0);
    corrected.sigma[k] = scale_[k] * std::sqrt(told.variance[0] + p.noiseVariance());
    left += weightOf(k) * told.variance[0];
    all += weightOf(k) * p.signalVariance();
  }
  const double faded = fading(corrected.pose.translation());
  corrected.confidence = faded * std::max(1.0 - left / all, 0.0);
  corrected.pose = features_.corrected(corrected.pose, faded * correction);
  return corrected;
}

std::vector<Eigen::Isometry3d> CorrectionModel::correct(const std::vector<State>& seen) const {
  std::vector<Eigen::Isometry3d> poses;
  const MatrixXd x = featuresOf(seen);
  MatrixXd corrections = MatrixXd::Zero(x.rows(), kOutputs);
  for (std::size_t k = 0; k < processes_.size(); ++k)
    corrections.col(static_cast<Index>(k)) = scale_[static_cast<Index>(k)] * processes_[k].mean(x);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Eigen::Isometry3d moved = offset_ * seen[k].pair.seen;
    const Vector6d correction = corrections.row(static_cast<Index>(k)).transpose();
    poses.push_back(features_.corrected(moved, fading(moved.translation()) * correction));
  }
  return poses;
}

Eigen::VectorXd CorrectionModel::confidence(const std::vector<State>& desired) const {
  Eigen::VectorXd sure = Eigen::VectorXd::Zero(static_cast<Index>(desired.size()));
  if (processes_.empty()) return sure;
  const MatrixXd x = featuresOf(desired);
  Eigen::VectorXd left = sure;
  double all = 0.0;
  for (Index k = 0; k < kOutputs; ++k) {
    const SparseProcess& process = processes_[static_cast<std::size_t>(k)];
    left += weightOf(k) * process.predict(x).variance;
    all += weightOf(k) * process.parameters().signalVariance();
  }
  for (std::size_t k = 0; k < desired.size(); ++k) {
    const auto at = static_cast<Index>(k);
    sure[at] = fading((offset_ * desired[k].pair.seen).translation()) * std::max(1.0 - left[at] / all, 0.0);
  }
  return sure;
}

double CorrectionModel::weightOf(Eigen::Index output) const {
  return std::pow(scale_[output] * (output < 3 ? 1.0 : lever_), 2);
}

double CorrectionModel::fading(const Eigen::Vector3d& position) const {
  return std::exp(-0.5 * workspace_.squaredExteriorDistance(position) / (kFade * kFade));
}

void CorrectionModel::add(const std::vector<State>& states) {
  const MatrixXd x = featuresOf(states), y = targetsOf(states);
  for (const State& state : states) workspace_.extend((offset_ * state.pair.seen).translation());
  for (std::size_t k = 0; k < processes_.size(); ++k) processes_[k].add(x, y.col(static_cast<Index>(k)));
}

}  // namespace capstan::learning
