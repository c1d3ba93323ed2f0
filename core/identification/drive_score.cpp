#include "core/identification/drive_score.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "core/identification/drive_model.h"
#include "core/identification/drive_parameters.h"

namespace capstan::identification {
namespace {

/// Calls use(row) for every row from `skip` seconds on that has a joint encoder value.
template <class Use>
void forRows(const DriveRecording& recording, double skip, Use&& use) {
  for (std::size_t k = 0; k < recording.size(); ++k)
    if (recording.t[k] - recording.t.front() >= skip && !std::isnan(recording.q[k])) use(k);
}

double torqueAt(const DriveRecording& recording, std::size_t k) {
  return std::isnan(recording.tau_m[k]) ? 0.0 : recording.tau_m[k];
}

/// Regressors and reference of row k: 1, q_m, tau_m, q.
Eigen::Vector4d rowOf(const DriveRecording& recording, std::size_t k) {
  return {1.0, recording.q_m[k], torqueAt(recording, k), recording.q[k]};
}

}  // namespace

DriveScore scoreOf(const std::vector<DriveRecording>& recordings, const DriveResiduals& residuals,
                   OffsetRule rule, double skip) {
  DriveScore score;
  double all = 0.0, count = 0.0;
  for (std::size_t file = 0; file < recordings.size(); ++file) {
    double n = 0.0, sum = 0.0, squares = 0.0;
    forRows(recordings[file], skip, [&](std::size_t k) { n += 1.0, sum += residuals[file][k]; });
    const double offset = rule == OffsetRule::kEach && n > 0.0 ? sum / n : 0.0;
    forRows(recordings[file], skip, [&](std::size_t k) {
      const double rest = residuals[file][k] - offset;
      squares += rest * rest;
    });
    score.file_rms.push_back(std::sqrt(squares / std::max(1.0, n)));
    score.offset.push_back(offset);
    all += squares;
    count += n;
  }
  score.rms = std::sqrt(all / std::max(1.0, count));
  return score;
}

DriveScore scoreDrive(const robot::Description& robot, const std::vector<DriveRecording>& recordings,
                      OffsetRule rule, double skip) {
  const DriveParameters parameters(robot, "r_l");
  const DriveLogs logs = DriveLogs::Zero();
  const DriveLaw<double> law = parameters.law<double>(logs.data());
  DriveResiduals residuals;
  DrivePrediction<double> prediction;
  for (const DriveRecording& recording : recordings) {
    predict(law, recording, prediction);
    residuals.push_back(recording.q);
    for (std::size_t k = 0; k < recording.size(); ++k) residuals.back()[k] -= prediction.q[k];
  }
  return scoreOf(recordings, residuals, rule, skip);
}

LinearDrive fitLinear(const std::vector<DriveRecording>& training, bool stretch, OffsetRule rule,
                      double skip) {
  Eigen::Matrix4d moments = Eigen::Matrix4d::Zero();
  for (const DriveRecording& recording : training) {
    double n = 0.0;
    Eigen::Vector4d mean = Eigen::Vector4d::Zero();
    if (rule == OffsetRule::kEach) {
      forRows(recording, skip, [&](std::size_t k) { n += 1.0, mean += rowOf(recording, k); });
      mean /= std::max(1.0, n);
    }
    forRows(recording, skip, [&](std::size_t k) {
      const Eigen::Vector4d row = rowOf(recording, k) - mean;
      moments += row * row.transpose();
    });
  }
  // The normal equation of a coefficient that is not fitted is w = 0.
  Eigen::Matrix3d normal = moments.topLeftCorner<3, 3>();
  Eigen::Vector3d right = moments.topRightCorner<3, 1>();
  const auto drop = [&](int i) {
    normal.row(i).setZero();
    normal.col(i).setZero();
    normal(i, i) = 1.0;
    right(i) = 0.0;
  };
  if (rule == OffsetRule::kEach) drop(0);
  if (!stretch || normal(2, 2) == 0.0) drop(2);
  const Eigen::Vector3d w = normal.ldlt().solve(right);
  return {w(0), w(1), w(2)};
}

DriveScore scoreLinear(const LinearDrive& line, const std::vector<DriveRecording>& recordings,
                       OffsetRule rule, double skip) {
  DriveResiduals residuals;
  for (const DriveRecording& recording : recordings) {
    residuals.push_back(recording.q);
    for (std::size_t k = 0; k < recording.size(); ++k)
      residuals.back()[k] -=
          line.offset + line.gain * recording.q_m[k] + line.compliance * torqueAt(recording, k);
  }
  return scoreOf(recordings, residuals, rule, skip);
}

LinearDrive nominalLine(const robot::Description& robot, const std::vector<DriveRecording>& training,
                        OffsetRule rule, double skip) {
  const robot::Drive& drive = robot.drives.front();
  LinearDrive line;
  line.gain =
      drive.motor_capstan_radius / (drive.gear_ratio * robot.coupling.front().front() * drive.link_radius);
  if (rule == OffsetRule::kEach) return line;
  double n = 0.0, sum = 0.0;
  for (const DriveRecording& recording : training)
    forRows(recording, skip,
            [&](std::size_t k) { n += 1.0, sum += recording.q[k] - line.gain * recording.q_m[k]; });
  line.offset = sum / std::max(1.0, n);
  return line;
}

}  // namespace capstan::identification
