#include "core/diagnosis/fit/start_of_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace capstan::diagnosis {

std::pair<double, double> lineAround(const std::vector<double>& column, std::size_t begin, std::size_t end,
                                     double step) {
  double n = 0, st = 0, stt = 0, sx = 0, stx = 0;
  for (std::size_t k = begin; k < end; ++k) {
    if (!std::isfinite(column[k])) continue;
    const double t = static_cast<double>(k - begin) * step;
    n += 1, st += t, stt += t * t, sx += column[k], stx += t * column[k];
  }
  const double det = n * stt - st * st;
  if (n < 2 || det <= 0.0) return {n > 0 ? sx / n : std::numeric_limits<double>::quiet_NaN(), 0.0};
  const double slope = (n * stx - st * sx) / det;
  return {(sx - slope * st) / n, slope};
}

std::pair<double, double> parabolaFrom(const std::vector<double>& column, std::size_t begin, std::size_t end,
                                       double step) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double span = static_cast<double>(end - begin) * step;
  for (std::size_t k = begin; k < end; ++k) {
    if (!std::isfinite(column[k])) continue;
    const double s = static_cast<double>(k - begin) * step / span;
    const Eigen::Vector3d row(1.0, s, s * s);
    normal += row * row.transpose();
    right += column[k] * row;
  }
  if (!(normal(0, 0) >= 4.0)) return lineAround(column, begin, end, step);
  const Eigen::Vector3d found = normal.ldlt().solve(right);
  return {found[0], found[1] / span};
}

}  // namespace capstan::diagnosis
