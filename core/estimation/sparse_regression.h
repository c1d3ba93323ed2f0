#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/estimation/information.h"

namespace capstan::estimation {

/// Bayesian linear regression in which some coefficients may be absent.
///
///     z_k = H_k x + v_k,   v_k ~ N(0, R_k),   x = [optional (K); present (N − K)]
///
/// Each optional coefficient is zero, or has the prior N(0, sigma²) with a stated prior probability (spike
/// and slab; Mitchell and Beauchamp, JASA 83, 1988). The present coefficients have the prior of one of two
/// regimes, e.g. a camera that is mounted as registered and one that was moved since. The 2 · 2^K submodels
/// share one information matrix (Information), so that the evidence of each has a closed form:
///
///     log p(z | S) = ½ h_Sᵀ (Λ_S + I)⁻¹ h_S − ½ log det(Λ_S + I) + const.
///
/// The estimate is that of one submodel. An optional coefficient enters it when its inclusion probability
/// exceeds Prior::enters, and stays while that probability exceeds ½, as in the median probability model
/// (Barbieri and Berger, Annals of Statistics 32, 2004). All other optional coefficients are exactly zero.
///
/// No allocation. One select() computes 2 · 2^K Cholesky factors of size K × K.
template <int N, int K>
class SparseRegression {
 public:
  static constexpr int kPresent = N - K;
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  using Optional = Eigen::Matrix<double, K, 1>;
  using Present = Eigen::Matrix<double, kPresent, 1>;

  /// Standard deviations in the units of x, probabilities in (0, 1).
  struct Prior {
    Optional sigma;                  ///< standard deviations of optional coefficients that are not zero
    Optional inclusion_probability;  ///< probabilities that optional coefficients are not zero
    Present usual_sigma;             ///< standard deviations of present coefficients in the usual regime
    Present unusual_sigma;           ///< the same in the unusual regime; none below usual_sigma
    double unusual_probability = 0.0;
    Optional enters = Optional::Constant(0.5);  ///< inclusion probability above which one is estimated
    /// Lowest and highest estimate of an optional coefficient; one with an estimate outside is absent.
    Optional lowest = Optional::Constant(-std::numeric_limits<double>::infinity());
    Optional highest = Optional::Constant(std::numeric_limits<double>::infinity());
  };

  explicit SparseRegression(const Prior& prior) : prior_(prior) {
    sigma_ << prior.sigma, prior.usual_sigma;
    select({});
  }

  /// Prior standard deviations of all coefficients, which are the units of Information.
  const Vector& sigma() const { return sigma_; }
  /// Precision of the prior with every coefficient present, in the unusual regime, in units of sigma().
  Vector widestPrecision() const {
    Vector all = Vector::Ones();
    all.template tail<kPresent>() = precision(true);
    return all;
  }

  /// Sets the prior probabilities for all following calls of select().
  void setPrior(const Optional& inclusion_probability, double unusual_probability) {
    prior_.inclusion_probability = inclusion_probability;
    prior_.unusual_probability = unusual_probability;
  }

  /// Computes the posterior probabilities of all submodels and updates the estimate.
  void select(const Information<N>& information);

  const Information<N>& information() const { return information_; }
  const Vector& mean() const { return mean_; }
  /// Posterior covariance of the selected submodel; zero for absent coefficients.
  const Matrix& covariance() const { return covariance_; }
  /// covariance() with the weight of all observations multiplied by `factor`.
  Matrix covarianceDiscounted(double factor) const { return posterior(factor).covariance; }
  /// Posterior probability that each optional coefficient is not zero.
  const Optional& inclusionProbability() const { return inclusion_; }
  bool included(int i) const { return ((included_ >> i) & 1U) != 0U; }
  double unusualProbability() const { return unusual_; }

 private:
  static constexpr int kSubmodels = 1 << K;
  using Block = Eigen::Matrix<double, K, K>;
  using PresentBlock = Eigen::Matrix<double, kPresent, kPresent>;
  struct Posterior {
    Vector mean;
    Matrix covariance;
  };

  Present precision(bool unusual) const {
    if (!unusual) return Present::Ones();
    return prior_.usual_sigma.cwiseQuotient(prior_.unusual_sigma).cwiseAbs2();
  }
  void weighSubmodels();
  void evidenceOf(bool unusual, std::array<double, kSubmodels>& log_evidence) const;
  Posterior posterior(double factor) const;

  Prior prior_;
  Vector sigma_;
  Information<N> information_;
  Vector mean_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  Optional inclusion_ = Optional::Zero();
  double unusual_ = 0.0;
  unsigned included_ = 0;  ///< optional coefficients of the selected submodel, one bit per coefficient
  unsigned impossible_ =
      0;  ///< optional coefficients with estimates outside their range, one bit per coefficient
};

/// Log evidence plus log prior probability of each submodel of one regime. The present coefficients are
/// integrated out first (Schur complement).
template <int N, int K>
void SparseRegression<N, K>::evidenceOf(bool unusual, std::array<double, kSubmodels>& log_evidence) const {
  PresentBlock present = information_.matrix.template bottomRightCorner<kPresent, kPresent>();
  const Present prior_precision = precision(unusual);
  present.diagonal() += prior_precision;
  const Eigen::LLT<PresentBlock> root(present);
  const Eigen::Matrix<double, kPresent, K> cross =
      root.matrixL().solve(information_.matrix.template bottomLeftCorner<kPresent, K>());
  const Present y = root.matrixL().solve(information_.score.template tail<kPresent>());
  const Block whole = information_.matrix.template topLeftCorner<K, K>() - cross.transpose() * cross;
  const Optional score = information_.score.template head<K>() - cross.transpose() * y;
  const double probability = unusual ? prior_.unusual_probability : 1.0 - prior_.unusual_probability;
  const double shared = 0.5 * y.squaredNorm() - root.matrixLLT().diagonal().array().log().sum() +
                        0.5 * prior_precision.array().log().sum() + std::log(probability);

  for (int submodel = 0; submodel < kSubmodels; ++submodel) {
    if ((static_cast<unsigned>(submodel) & impossible_) != 0U) continue;
    Block block = Block::Identity();
    Optional kept = Optional::Zero();
    double log_evidence_here = shared;
    for (int i = 0; i < K; ++i) {
      const double p = prior_.inclusion_probability(i);
      const bool in = (submodel >> i) & 1;
      log_evidence_here += std::log(in ? p : 1.0 - p);
      if (!in) continue;
      kept(i) = score(i);
      for (int j = 0; j < K; ++j)
        if ((submodel >> j) & 1) block(i, j) += whole(i, j);
    }
    const Eigen::LLT<Block> factor(block);
    const Optional whitened = factor.matrixL().solve(kept);
    log_evidence[static_cast<std::size_t>(submodel)] =
        log_evidence_here + 0.5 * whitened.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum();
  }
}

template <int N, int K>
void SparseRegression<N, K>::select(const Information<N>& information) {
  information_ = information;
  impossible_ = 0;
  for (int round = 0; round <= K; ++round) {
    weighSubmodels();
    const unsigned before = impossible_;
    for (int i = 0; i < K; ++i)
      if (!(mean_(i) >= prior_.lowest(i) && mean_(i) <= prior_.highest(i))) impossible_ |= 1U << i;
    if (impossible_ == before) return;
  }
}

template <int N, int K>
void SparseRegression<N, K>::weighSubmodels() {
  std::array<std::array<double, kSubmodels>, 2> evidence;
  evidenceOf(false, evidence[0]);
  evidenceOf(true, evidence[1]);
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& regime : evidence)
    for (int submodel = 0; submodel < kSubmodels; ++submodel)
      if ((static_cast<unsigned>(submodel) & impossible_) == 0U)
        best = std::max(best, regime[static_cast<std::size_t>(submodel)]);
  double total = 0.0, unusual = 0.0;
  Optional inclusion = Optional::Zero();
  for (int regime = 0; regime < 2; ++regime)
    for (int submodel = 0; submodel < kSubmodels; ++submodel) {
      if ((static_cast<unsigned>(submodel) & impossible_) != 0U) continue;
      const double weight =
          std::exp(evidence[static_cast<std::size_t>(regime)][static_cast<std::size_t>(submodel)] - best);
      total += weight;
      if (regime == 1) unusual += weight;
      for (int i = 0; i < K; ++i)
        if ((submodel >> i) & 1) inclusion(i) += weight;
    }
  inclusion_ = inclusion / total;
  unusual_ = unusual / total;
  for (int i = 0; i < K; ++i) {
    if (inclusion_(i) > prior_.enters(i)) included_ |= 1U << i;
    if (inclusion_(i) <= 0.5) included_ &= ~(1U << i);
  }
  included_ &= ~impossible_;
  const Posterior now = posterior(1.0);
  mean_ = now.mean;
  covariance_ = now.covariance;
}

template <int N, int K>
auto SparseRegression<N, K>::posterior(double factor) const -> Posterior {
  Matrix block = factor * information_.matrix;
  Vector score = factor * information_.score;
  block.diagonal().template head<K>().array() += 1.0;
  block.diagonal().template tail<kPresent>() += precision(unusual_ > 0.5);
  for (int i = 0; i < K; ++i) {
    if (included(i)) continue;
    block.row(i).setZero();
    block.col(i).setZero();
    block(i, i) = 1.0;
    score(i) = 0.0;
  }
  const Eigen::LLT<Matrix> root(block);
  Posterior result;
  result.mean = sigma_.cwiseProduct(root.solve(score));
  result.covariance = sigma_.asDiagonal() * root.solve(Matrix::Identity()) * sigma_.asDiagonal();
  for (int i = 0; i < K; ++i)
    if (!included(i)) result.covariance(i, i) = 0.0;
  return result;
}

}  // namespace capstan::estimation
