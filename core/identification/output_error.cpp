#include "core/identification/output_error.h"

#include <Eigen/Cholesky>

namespace capstan::identification {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d crossMatrix(const Vector3d& v) {
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

Vector3d centreOf(const IdentificationData& data) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const CameraObservation& seen : data.cameras)
    if (seen.open) {
      sum += seen.tip;
      count += 1.0;
    }
  return count > 0.0 ? Vector3d(sum / count) : sum;
}

OutputError::OutputError(const IdentificationData& data, const ParameterSet& set,
                         const CameraPoseOptions& pose, const ShootingOptions& shooting)
    : data_(data),
      set_(set),
      shooting_(data, set, shooting),
      arm_(data.robot),
      scale_(set.size() + CameraPose::kSize),
      centre_(centreOf(data)) {
  for (int i = 0; i < set.size(); ++i) scale_(i) = set[i].prior_sigma;
  scale_.tail(CameraPose::kSize) = pose.sigmas();
  whitening_.reserve(shooting_.used().size());
  for (int k = 0; k < observations(); ++k) {
    const Matrix3d root = observation(k).tip_covariance.llt().matrixL();
    whitening_.push_back(root.inverse());
  }
}

CameraPose OutputError::pose(const Vector& x) const {
  return cameraPoseOf(scale_.tail<CameraPose::kSize>().cwiseProduct(x.tail<CameraPose::kSize>()));
}

bool OutputError::evaluate(const Vector& x, Vector& residuals, Eigen::MatrixXd* jacobian,
                           const base::Progress* progress) {
  if (!shooting_.predict(logs(x), jacobian != nullptr, predictions_, progress)) return false;
  compare(x, residuals, jacobian);
  return true;
}

Matrix3d OutputError::residualByJoint(const Vector& x, int k) const {
  const CameraPose camera = pose(x);
  const ArmPrediction& arm = predictions_[static_cast<std::size_t>(k)];
  return -whitening_[static_cast<std::size_t>(k)] * (Matrix3d::Identity() + crossMatrix(camera.rotation)) *
         arm_.tipJacobian(arm.q - camera.delay * arm.dq);
}

void OutputError::compare(const Vector& x, Vector& residuals, Eigen::MatrixXd* jacobian) const {
  const int n = set_.size();
  const CameraPose camera = pose(x);
  const Matrix3d rotated = Matrix3d::Identity() + crossMatrix(camera.rotation);
  residuals.resize(3 * observations());
  if (jacobian) jacobian->resize(3 * observations(), unknowns());
  for (int k = 0; k < observations(); ++k) {
    const ArmPrediction& arm = predictions_[static_cast<std::size_t>(k)];
    const Matrix3d& white = whitening_[static_cast<std::size_t>(k)];
    const Vector3d q = arm.q - camera.delay * arm.dq;
    const Vector3d tip = arm_.tip(q);
    residuals.segment<3>(3 * k) = white * (observation(k).tip - camera.seen(tip, centre_));
    if (!jacobian) continue;
    const Matrix3d by_joint = white * rotated * arm_.tipJacobian(q);
    auto rows = jacobian->middleRows<3>(3 * k);
    rows.leftCols(n) = -by_joint * (arm.q_by_log - camera.delay * arm.dq_by_log).leftCols(n);
    rows.middleCols<3>(n) = white * crossMatrix(tip - centre_);
    rows.middleCols<3>(n + 3) = -white;
    rows.col(n + 6) = by_joint * arm.dq;
    rows *= scale_.asDiagonal();
  }
}

}  // namespace capstan::identification
