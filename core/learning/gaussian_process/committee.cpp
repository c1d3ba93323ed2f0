#include "core/learning/gaussian_process/committee.h"

#include "core/base/check.h"

namespace capstan::learning {

using Eigen::MatrixXd;

Committee::Committee(std::vector<SparseProcess> members) : members_(std::move(members)) {
  CAPSTAN_CHECK(!members_.empty());
}

void Committee::add(const MatrixXd& x, const MatrixXd& y, const Eigen::VectorXd& besides) {
  for (SparseProcess& member : members_) member.add(x, y, besides);
}

MatrixXd Committee::mean(const MatrixXd& at) const {
  MatrixXd sum = MatrixXd::Zero(at.rows(), outputs());
  for (const SparseProcess& member : members_) sum += member.mean(at);
  return sum / static_cast<double>(members_.size());
}

Prediction Committee::predict(const MatrixXd& at) const {
  const auto members = static_cast<double>(members_.size());
  Prediction all{MatrixXd::Zero(at.rows(), outputs()), Eigen::VectorXd::Zero(at.rows())};
  std::vector<MatrixXd> means;
  for (const SparseProcess& member : members_) {
    Prediction own = member.predict(at);
    all.mean += own.mean / members;
    all.variance += own.variance / members;
    means.push_back(std::move(own.mean));
  }
  const double shares = members * static_cast<double>(outputs());
  for (const MatrixXd& own : means) all.variance += (own - all.mean).rowwise().squaredNorm() / shares;
  return all;
}

MatrixXd Committee::covariance(const MatrixXd& at) const {
  const auto members = static_cast<double>(members_.size());
  const double shares = members * static_cast<double>(outputs());
  const MatrixXd middle = mean(at);
  MatrixXd all = MatrixXd::Zero(at.rows(), at.rows());
  for (const SparseProcess& member : members_) {
    const MatrixXd apart = member.mean(at) - middle;
    all += member.covariance(at) / members + apart * apart.transpose() / shares;
  }
  return all;
}

double Committee::signalVariance() const {
  double sum = 0.0;
  for (const SparseProcess& member : members_) sum += member.parameters().signalVariance();
  return sum / static_cast<double>(members_.size());
}

double Committee::noiseVariance() const {
  double sum = 0.0;
  for (const SparseProcess& member : members_) sum += member.parameters().noiseVariance();
  return sum / static_cast<double>(members_.size());
}

}  // namespace capstan::learning
