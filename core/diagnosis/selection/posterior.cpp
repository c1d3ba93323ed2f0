#include "core/diagnosis/selection/posterior.h"

namespace capstan::diagnosis {

double logPrior(std::size_t effects, int candidates) {
  const auto k = static_cast<double>(effects), n = static_cast<double>(std::max(candidates, 1));
  const double choices =
      k <= n ? std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) : 0.0;
  return k * std::log(kEffectOdds) - choices;
}

Eigen::VectorXd baggedPosterior(const Eigen::MatrixXd& log_scores) {
  Eigen::VectorXd probability = Eigen::VectorXd::Zero(log_scores.rows());
  for (const auto& draw : log_scores.colwise()) {
    const Eigen::VectorXd odds = (draw.array() - draw.maxCoeff()).exp();
    probability += odds / odds.sum();
  }
  return probability / static_cast<double>(log_scores.cols());
}

}  // namespace capstan::diagnosis
