#include "core/learning/model/next_poses.h"

#include "core/learning/poses/rotation_vector.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Covariance of all candidates for one process after the queries so far.
struct Open {
  MatrixXd covariance;
  double weight, noise;

  /// Reduction of the sum of all variances by a query at i.
  double gainOf(Index i) const {
    return weight * covariance.col(i).squaredNorm() / (covariance(i, i) + noise);
  }
  void query(Index i) {
    const Eigen::VectorXd column = covariance.col(i) / std::sqrt(covariance(i, i) + noise);
    covariance -= column * column.transpose();
  }
};

std::vector<Open> openOf(const CorrectionModel& model, const std::vector<State>& candidates) {
  const MatrixXd x = model.featuresOf(candidates);
  std::vector<Open> open;
  for (std::size_t g = 0; g < model.processes().size(); ++g) {
    const Committee& process = model.processes()[g];
    open.push_back({process.covariance(x), model.weightOf(g), process.noiseVariance()});
  }
  return open;
}

/// Positions and rotations of the model's inducing points, as standardised features.
MatrixXd learnedPoses(const CorrectionModel& model) {
  constexpr Index kPose = 6;
  MatrixXd all(0, kPose);
  for (const SparseProcess& member : model.processes().front().members()) {
    Eigen::VectorXd length = member.parameters().ln_length.array().exp();
    if (length.size() == 1) length = Eigen::VectorXd::Constant(kPose, length[0]);
    const Index before = all.rows();
    all.conservativeResize(before + member.inducing(), Eigen::NoChange);
    all.bottomRows(member.inducing()) =
        member.parts().inducing.leftCols(kPose) * length.head(kPose).asDiagonal();
  }
  return all;
}

}  // namespace

std::vector<NextPose> nextPoses(const CorrectionModel& model, const std::vector<State>& candidates,
                                std::size_t count, base::Progress* progress) {
  std::vector<NextPose> chosen;
  std::vector<Open> open = openOf(model, candidates);
  std::vector<bool> queried(candidates.size(), false);
  double whole = 0.0, left = 0.0;  // total variance without data, and at present
  for (std::size_t g = 0; g < open.size(); ++g) {
    whole += open[g].weight * model.processes()[g].signalVariance() * static_cast<double>(candidates.size());
    left += open[g].weight * open[g].covariance.trace();
  }
  while (chosen.size() < std::min(count, candidates.size()) && !(progress && progress->cancelled())) {
    if (progress)
      progress->report(static_cast<double>(chosen.size()) / static_cast<double>(count), "choosing poses");
    double most = 0.0;
    std::size_t best = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (queried[i]) continue;
      double gain = 0.0;
      for (const Open& one : open) gain += one.gainOf(static_cast<Index>(i));
      if (gain > most) most = gain, best = i;
    }
    if (!(most > kLeastGain * left)) break;
    for (Open& one : open) one.query(static_cast<Index>(best));
    queried[best] = true;
    chosen.push_back({best, left / whole, (left - most) / whole});
    left -= most;
  }
  return chosen;
}

std::vector<State> posesWithin(const CorrectionModel& model, int each) {
  const CorrectionParts parts = model.parts();
  const Eigen::Isometry3d observed_from_commanded = parts.offset.inverse();
  std::vector<Eigen::Vector3d> turns = {Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {parts.turns.min()[axis], parts.turns.max()[axis]})
      turns.push_back(end * Eigen::Vector3d::Unit(axis));
  const Eigen::Vector3d step = parts.workspace.sizes() / std::max(each - 1, 1);
  std::vector<State> all;
  for (int k = 0; k < each * each * each; ++k)
    for (const Eigen::Vector3d& rotation : turns) {
      const Eigen::Vector3d place(k % each, k / each % each, k / each / each);
      Eigen::Isometry3d commanded = Eigen::Isometry3d::Identity();
      commanded.translation() = parts.workspace.min() + step.cwiseProduct(place);
      commanded.linear() = (parts.features.middle() * turnBy(rotation)).toRotationMatrix();
      all.emplace_back();
      all.back().pair.observed = observed_from_commanded * commanded;
    }
  const MatrixXd x = model.featuresOf(all), learned = learnedPoses(model);
  Eigen::RowVectorXd reach(6);
  reach << step.transpose(), 0.5 * parts.turns.sizes().transpose();
  reach = (reach.array() + 1e-9) / parts.deviation.leftCols(6).array();  // a rotation may never have changed
  std::vector<State> near;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const MatrixXd off = (learned.rowwise() - x.row(static_cast<Index>(k)).leftCols(6)).cwiseAbs();
    if (((off.array().rowwise() - reach.array()).rowwise().maxCoeff() <= 0.0).any()) near.push_back(all[k]);
  }
  return near;
}

}  // namespace capstan::learning
