#include "core/learning/model/correction_model.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/learning/poses/choose_motion.h"
#include "core/learning/poses/rotation_vector.h"
#include "core/math/dense.h"
#include "core/stats/quantile.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr Index kOutputs = 6;
/// Outputs that share a kernel.
struct Group {
  Index first, count;
};
constexpr std::array<Group, 4> kGroups = {{{0, 1}, {1, 1}, {2, 1}, {3, 3}}};

constexpr double kChoiceShare = 0.3;                // share of the time for the choice of motion features
constexpr double kFitShare = 0.6, kAllShare = 0.3;  // shares of the time: hyperparameters, all states
/// Seeds of the members' draws, different for each seed of the options.
constexpr std::uint64_t kDraws = 1000, kInducingDraw = 300, kCalibrationDraw = 600;

/// Additional variance of each state in a group's outputs, divided by the squared scales; the mean over the
/// outputs.
Eigen::VectorXd downWeightsOf(const std::vector<State>& states, const Group& group,
                              const Eigen::RowVectorXd& scale) {
  const Eigen::VectorXd precision =
      scale.segment(group.first, group.count).array().square().inverse().transpose();
  Eigen::VectorXd down_weights(static_cast<Index>(states.size()));
  for (std::size_t k = 0; k < states.size(); ++k)
    down_weights[static_cast<Index>(k)] =
        precision.dot(states[k].extra_variance.segment(group.first, group.count));
  return down_weights / static_cast<double>(group.count);
}

/// Hyperparameters of each group's members.
using GroupParameters = std::array<std::vector<KernelParameters>, kGroups.size()>;

/// Number of members: one if every member would have all states, because members would then be equal.
std::size_t membersOf(Index states, const CorrectionOptions& options) {
  const bool all = states <= options.likelihood_points && states <= options.inducing_points;
  return all ? 1 : static_cast<std::size_t>(std::max(options.members, 1));
}

/// Fits the hyperparameters of every member of every group to its own random states.
GroupParameters fitted(const MatrixXd& x, const MatrixXd& y, const CorrectionOptions& options,
                       base::Progress* progress, const base::ProgressPart& part) {
  constexpr const char* kLearning = "learning hyperparameters";
  const std::size_t members = membersOf(x.rows(), options), fits = kGroups.size() * members;
  GroupParameters found;
  found.fill(std::vector<KernelParameters>(members));
  part.report(progress, 0.0, kLearning);
  std::atomic<int> ready = 0;
  math::setDenseThreads(1);
  base::parallelFor(fits, options.threads, [&](std::size_t fit) {
    const std::size_t member = fit / kGroups.size(), g = fit % kGroups.size();
    const auto drawn = drawnPoints(x.rows(), options.likelihood_points, kDraws * options.seed + member);
    const MatrixXd own_x = x(drawn, Eigen::all);
    const MatrixXd own_y = y(drawn, Eigen::seqN(kGroups[g].first, kGroups[g].count));
    const KernelParameters start = startOf(own_x, own_y, options.fit);
    found[g][member] = fitProcess(own_x, own_y, start, options.fit, progress).parameters;
    part.report(progress, ++ready / static_cast<double>(fits), kLearning);
  });
  return found;
}

/// Committee of a group with given hyperparameters and the states of `x` and `y`; each member's inducing
/// points are drawn from `x`.
Committee committeeOf(const Group& group, const MatrixXd& x, const MatrixXd& y,
                      const Eigen::VectorXd& down_weights, const std::vector<KernelParameters>& members,
                      Index inducing_points, std::uint64_t seed) {
  std::vector<SparseProcess> processes;
  for (const KernelParameters& parameters : members)
    processes.emplace_back(x(drawnPoints(x.rows(), inducing_points, seed++), Eigen::all), group.count,
                           parameters);
  Committee committee(std::move(processes));
  committee.add(x, y.middleCols(group.first, group.count), down_weights);
  return committee;
}

/// Calls work(g) for every group, side by side and each with one BLAS thread. Several BLAS threads would wait
/// for each other in busy loops, which is slow on a busy machine, and would change the order of sums.
template <class Work>
void forEachGroup(int threads, const Work& work) {
  math::setDenseThreads(1);
  base::parallelFor(kGroups.size(), threads, work);
}

std::vector<KernelParameters> parametersOf(const Committee& committee) {
  std::vector<KernelParameters> all;
  for (const SparseProcess& member : committee.members()) all.push_back(member.parameters());
  return all;
}

/// Factor on σ for which the shares of |e| / σ (`multiples`) within σ and 2 σ are at least those of a normal
/// distribution. For normal errors it is slightly above 1, because it is the larger of two random quantiles.
/// It is 1 for an output without errors.
double inflationOf(const std::vector<double>& multiples) {
  constexpr std::array<double, 2> kShares = {kWithinSigma, kWithinTwoSigma};
  const std::vector<double> at = stats::quantiles(multiples, kShares);
  const double factor = std::max(at[0], at[1] / 2.0);
  return factor > 0.0 ? factor : 1.0;
}

void checkEnough(std::size_t states) {
  if (states < kFewestStates)
    throw base::InputError({{},
                            0,
                            "states",
                            fmt::format("{}", states),
                            fmt::format("are too few to learn from; at least {} are needed", kFewestStates),
                            "Record longer, or use wider cleaning limits"});
}

}  // namespace

Vector6d errorsInSigma(const Corrected& corrected, const Eigen::Isometry3d& commanded) {
  const PoseFeatures tangent(RotationForm::kTangent, Motion::kNone, Eigen::Quaterniond::Identity());
  return tangent.correction(corrected.pose, commanded).cwiseQuotient(corrected.sigma);
}

CorrectionModel::CorrectionModel(CorrectionParts parts) : known_(std::move(parts)) {
  for (std::vector<SparseProcessParts>& group : known_.groups) {
    std::vector<SparseProcess> members;
    for (SparseProcessParts& member : group) members.emplace_back(std::move(member));
    processes_.emplace_back(std::move(members));
  }
  known_.groups.clear();
}

CorrectionParts CorrectionModel::parts() const {
  CorrectionParts parts = known_;
  for (const Committee& committee : processes_) {
    parts.groups.emplace_back();
    for (const SparseProcess& member : committee.members()) parts.groups.back().push_back(member.parts());
  }
  return parts;
}

CorrectionModel CorrectionModel::rigid(const std::vector<State>& states, const CorrectionOptions& options) {
  checkEnough(states.size());
  const std::vector<PosePair> pairs = pairsOf(states);
  CorrectionParts parts;
  parts.offset = options.offset ? *options.offset : rigidOffset(pairs);
  std::vector<Eigen::Isometry3d> moved;
  for (const PosePair& pair : pairs) moved.push_back(parts.offset * pair.observed);
  parts.features =
      PoseFeatures(options.rotation, options.motion.value_or(Motion::kVelocity), meanRotation(moved));
  CorrectionModel model(std::move(parts));
  for (const Eigen::Isometry3d& pose : moved) model.extendBy(pose);
  model.findScales(states);
  return model;
}

CorrectionModel CorrectionModel::trained(const std::vector<State>& states, const CorrectionOptions& options,
                                         base::Progress* progress, const base::ProgressPart& part) {
  if (!options.motion) {
    CorrectionOptions chosen = options;
    chosen.motion = chooseMotion(states, options, progress, part.within(0.0, kChoiceShare));
    return trained(states, chosen, progress, part.within(kChoiceShare, 1.0));
  }
  CorrectionModel model = rigid(states, options);
  const MatrixXd x = model.featuresOf(states), y = model.targetsOf(states);

  const GroupParameters parameters = fitted(x, y, options, progress, part.within(0.0, kFitShare));
  std::array<std::optional<Committee>, kGroups.size()> committees;
  std::atomic<int> ready = 0;
  forEachGroup(options.threads, [&](std::size_t g) {
    if (progress && progress->cancelled()) return;
    committees[g] =
        committeeOf(kGroups[g], x, y, downWeightsOf(states, kGroups[g], model.known_.scale), parameters[g],
                    options.inducing_points, kDraws * options.seed + kInducingDraw);
    part.report(progress, kFitShare + kAllShare * ++ready / kGroups.size(), "learning all states");
  });
  if (progress && progress->cancelled()) return model;
  for (std::optional<Committee>& committee : committees) model.processes_.push_back(*std::move(committee));
  if (options.calibrate) model.findInflation(states, options);
  return model;
}

void CorrectionModel::findScales(const std::vector<State>& states) {
  const Index features = known_.features.size();
  known_.middle = Eigen::RowVectorXd::Zero(features);
  known_.deviation = Eigen::RowVectorXd::Ones(features);
  known_.scale = known_.inflation = Eigen::RowVectorXd::Ones(kOutputs);
  const auto orOne = [](double x) { return x > 1e-12 ? x : 1.0; };  // for constant columns
  MatrixXd x(static_cast<Index>(states.size()), features);
  for (std::size_t k = 0; k < states.size(); ++k)
    x.row(static_cast<Index>(k)) = known_.features.of(known_.offset, states[k]);
  known_.middle = x.colwise().mean();
  known_.deviation =
      (x.rowwise() - known_.middle).array().square().colwise().mean().sqrt().matrix().unaryExpr(orOne);
  known_.scale = targetsOf(states).array().square().colwise().mean().sqrt().matrix().unaryExpr(orOne);
}

MatrixXd CorrectionModel::featuresOf(const std::vector<State>& states) const {
  MatrixXd x(static_cast<Index>(states.size()), known_.features.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    x.row(static_cast<Index>(k)) = known_.features.of(known_.offset, states[k]);
  x = (x.rowwise() - known_.middle).array().rowwise() / known_.deviation.array();
  return x.cwiseMax(-kFarthestFeature).cwiseMin(kFarthestFeature);
}

MatrixXd CorrectionModel::targetsOf(const std::vector<State>& states) const {
  MatrixXd y(static_cast<Index>(states.size()), kOutputs);
  for (std::size_t k = 0; k < states.size(); ++k)
    y.row(static_cast<Index>(k)) =
        known_.features.correction(known_.offset * states[k].pair.observed, states[k].pair.commanded)
            .transpose();
  return y.array().rowwise() / known_.scale.array();
}

Corrected CorrectionModel::correct(const Eigen::Isometry3d& desired, const Vector6d& velocity) const {
  State state;
  state.pair.observed = desired;
  state.velocity = velocity;
  state.drift.fill(velocity);
  return correct(state);
}

Corrected CorrectionModel::correct(const State& desired) const {
  return correctWithConfidence({desired}).front();
}

std::vector<Corrected> CorrectionModel::correctWithConfidence(const std::vector<State>& desired) const {
  const Corrected rigid{Eigen::Isometry3d::Identity(), known_.scale.transpose(), 0.0};
  std::vector<Corrected> corrected(desired.size(), rigid);
  const auto n = static_cast<Index>(desired.size());
  MatrixXd corrections = MatrixXd::Zero(n, kOutputs), sigma = known_.scale.replicate(n, 1);
  Eigen::VectorXd left = Eigen::VectorXd::Zero(n);
  double all = 0.0;
  const MatrixXd x = featuresOf(desired);
  for (std::size_t g = 0; g < processes_.size(); ++g) {
    const auto [first, count] = kGroups[g];
    const Prediction commanded = processes_[g].predict(x);
    const Eigen::RowVectorXd scale = known_.scale.segment(first, count);
    corrections.middleCols(first, count) = commanded.mean * scale.asDiagonal();
    sigma.middleCols(first, count) =
        (commanded.variance.array() + processes_[g].noiseVariance()).sqrt().matrix() *
        scale.cwiseProduct(known_.inflation.segment(first, count));
    const double weight = weightOf(g);
    left += weight * commanded.variance;
    all += weight * processes_[g].signalVariance();
  }
  for (Index k = 0; k < n; ++k) {
    Corrected& one = corrected[static_cast<std::size_t>(k)];
    one.pose = known_.offset * desired[static_cast<std::size_t>(k)].pair.observed;
    one.sigma = sigma.row(k).transpose();
    if (processes_.empty()) continue;
    const double faded = fading(one.pose);
    one.confidence = faded * std::max(1.0 - left[k] / all, 0.0);
    one.pose = known_.features.corrected(one.pose, faded * corrections.row(k).transpose());
  }
  return corrected;
}

std::vector<Eigen::Isometry3d> CorrectionModel::correct(const std::vector<State>& desired) const {
  std::vector<Eigen::Isometry3d> poses;
  const MatrixXd x = featuresOf(desired);
  MatrixXd corrections = MatrixXd::Zero(x.rows(), kOutputs);
  for (std::size_t g = 0; g < processes_.size(); ++g)
    corrections.middleCols(kGroups[g].first, kGroups[g].count) = processes_[g].mean(x);
  corrections *= known_.scale.asDiagonal();
  for (std::size_t k = 0; k < desired.size(); ++k) {
    const Eigen::Isometry3d moved = known_.offset * desired[k].pair.observed;
    const Vector6d correction = corrections.row(static_cast<Index>(k)).transpose();
    poses.push_back(known_.features.corrected(moved, fading(moved) * correction));
  }
  return poses;
}

/// Calibrates σ by the errors of motions held out, predicted from the others with the same hyperparameters.
/// The shares within σ and 2 σ must be at least those of a normal distribution, because the errors have
/// heavier tails. Every eighth motion is held out (of a single motion an eighth of its duration); with few
/// motions more such eighths are held out in turn.
void CorrectionModel::findInflation(const std::vector<State>& states, const CorrectionOptions& options) {
  constexpr std::size_t kEighths = 8, kEnough = 20;  // number of motions held out
  const std::vector<std::size_t> places = motionPlaces(states);
  const std::size_t motions = places.back() + 1;
  const auto eighthOf = [&](std::size_t k) {
    return motions == 1 ? kEighths * k / states.size() : places[k] % kEighths;
  };
  const std::size_t folds = std::min(kEighths, (kEnough * kEighths + motions - 1) / motions);
  std::array<std::vector<double>, kOutputs> ratios;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<State> observed, held;
    for (std::size_t k = 0; k < states.size(); ++k)
      (eighthOf(k) == kEighths - 1 - fold ? held : observed).push_back(states[k]);
    if (!held.empty() && !observed.empty()) addRatios(observed, held, options, ratios);
  }
  for (std::size_t k = 0; k < ratios.size(); ++k)
    if (!ratios[k].empty()) known_.inflation[static_cast<Index>(k)] = inflationOf(ratios[k]);
}

/// Adds |e| / σ of the states held out, from a model of the other states.
void CorrectionModel::addRatios(const std::vector<State>& observed, const std::vector<State>& held,
                                const CorrectionOptions& options,
                                std::array<std::vector<double>, 6>& ratios) const {
  const MatrixXd x = featuresOf(observed), y = targetsOf(observed), at = featuresOf(held),
                 commanded = targetsOf(held);
  forEachGroup(options.threads, [&](std::size_t g) {
    const auto [first, count] = kGroups[g];
    const Committee committee = committeeOf(
        kGroups[g], x, y, downWeightsOf(observed, kGroups[g], known_.scale), parametersOf(processes_[g]),
        options.inducing_points, kDraws * options.seed + kCalibrationDraw);
    const Prediction guess = committee.predict(at);
    const Eigen::ArrayXd sigma = (guess.variance.array() + committee.noiseVariance()).sqrt();
    for (Index k = 0; k < count; ++k) {
      const Eigen::ArrayXd off = ((commanded.col(first + k) - guess.mean.col(k)).array() / sigma).abs();
      std::vector<double>& all = ratios[static_cast<std::size_t>(first + k)];
      all.insert(all.end(), off.begin(), off.end());
    }
  });
}

double CorrectionModel::weightOf(std::size_t process) const {
  const auto [first, count] = kGroups[process];
  return known_.scale.segment(first, count).squaredNorm() * (first < 3 ? 1.0 : known_.lever * known_.lever);
}

Eigen::VectorXd CorrectionModel::confidence(const std::vector<State>& desired) const {
  Eigen::VectorXd confident(static_cast<Index>(desired.size()));
  const std::vector<Corrected> corrected = correctWithConfidence(desired);
  for (std::size_t k = 0; k < corrected.size(); ++k)
    confident[static_cast<Index>(k)] = corrected[k].confidence;
  return confident;
}

Eigen::Vector3d CorrectionModel::turnOf(const Eigen::Isometry3d& moved) const {
  return rotationVector(known_.features.middle().conjugate() * Eigen::Quaterniond(moved.linear()));
}

void CorrectionModel::extendBy(const Eigen::Isometry3d& moved) {
  known_.workspace.extend(moved.translation());
  known_.turns.extend(turnOf(moved));
}

double CorrectionModel::fading(const Eigen::Isometry3d& moved) const {
  const double rotated = known_.lever * known_.lever * known_.turns.squaredExteriorDistance(turnOf(moved));
  const double away = known_.workspace.squaredExteriorDistance(moved.translation());
  return std::exp(-0.5 * (away + rotated) / (kFade * kFade));
}

void CorrectionModel::add(const std::vector<State>& states) {
  const MatrixXd x = featuresOf(states), y = targetsOf(states);
  for (const State& state : states) extendBy(known_.offset * state.pair.observed);
  for (std::size_t g = 0; g < processes_.size(); ++g)
    processes_[g].add(x, y.middleCols(kGroups[g].first, kGroups[g].count),
                      downWeightsOf(states, kGroups[g], known_.scale));
}

}  // namespace capstan::learning
