#include "core/simulation/recorded_trajectory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/recording/measured_table.h"

namespace capstan::simulation {
namespace {

class Recorded final : public Trajectory {
 public:
  explicit Recorded(const recording::MeasuredTable& table)
      : t_(table.t), q_(table.rows()), slope_(table.rows()) {
    const double start = t_.front();
    for (double& t : t_) t -= start;
    for (std::size_t row = 0; row < q_.size(); ++row)
      q_[row] = {table.q[0][row], table.q[1][row], table.q[2][row]};
    slope_.front() = slope_.back() = Eigen::Vector3d::Zero();
    for (std::size_t row = 1; row + 1 < q_.size(); ++row)
      slope_[row] = (q_[row + 1] - q_[row - 1]) / (t_[row + 1] - t_[row - 1]);
  }

  JointTarget at(double t) const override {
    if (t <= 0.0) return {q_.front(), Eigen::Vector3d::Zero()};
    if (t >= t_.back()) return {q_.back(), Eigen::Vector3d::Zero()};
    const auto next = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin());
    const double h = t_[next] - t_[next - 1], s = (t - t_[next - 1]) / h;
    const Eigen::Vector3d &a = q_[next - 1], &b = q_[next];
    const Eigen::Vector3d da = h * slope_[next - 1], db = h * slope_[next];
    const Eigen::Vector3d c2 = 3.0 * (b - a) - 2.0 * da - db, c3 = 2.0 * (a - b) + da + db;
    return {a + s * (da + s * (c2 + s * c3)), (da + s * (2.0 * c2 + 3.0 * s * c3)) / h};
  }

  double duration() const override { return t_.back(); }

 private:
  std::vector<double> t_;  // [s]
  std::vector<Eigen::Vector3d> q_, slope_;
};

}  // namespace

std::unique_ptr<Trajectory> recordedTrajectory(const std::string& file) {
  const recording::MeasuredTable table = recording::readMeasuredTable(file);
  if (table.q.size() != 3)
    throw base::InputError(
        {file, 1, "q1, q2, q3", {}, "are not all there", "Give a table with t, q1, q2, q3 (SI)"});
  if (table.rows() < 2)
    throw base::InputError({file, 0, {}, {}, "has fewer than two rows", "Give a longer recording"});
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(table.q[static_cast<std::size_t>(i)][row]))
        throw base::InputError({file,
                                static_cast<int>(row) + 2,
                                "q" + std::to_string(i + 1),
                                {},
                                "is empty",
                                "Remove rows without joint positions"});
  return std::make_unique<Recorded>(table);
}

}  // namespace capstan::simulation
