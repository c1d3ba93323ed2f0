#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/diagnosis/residuals/decimated_residual.h"

namespace capstan::diagnosis {

/// Sums over a set of samples: their number n, of the residual, and of the variable.
struct Cell {
  double n = 0.0, sum = 0.0, variable = 0.0;
  Cell& operator+=(const Cell& other) {
    n += other.n, sum += other.sum, variable += other.variable;
    return *this;
  }
};

/// Sums of a channel's samples by time block and by bin of a variable.
class BlockTable {
 public:
  /// `edges` rise. Bin b is [edges[b], edges[b + 1]); the first and the last bin have no outer limit.
  BlockTable(std::span<const double> residual, std::span<const double> variable, const TimeBlocks& blocks,
             std::span<const double> edges);

  std::size_t bins() const { return bins_; }
  std::size_t blocks() const { return squares_.size(); }
  const Cell& at(std::size_t block, std::size_t bin) const { return cells_[block * bins_ + bin]; }
  /// Σ e² over the samples of a block.
  double squares(std::size_t block) const { return squares_[block]; }

 private:
  std::size_t bins_;
  std::vector<Cell> cells_;
  std::vector<double> squares_;
};

/// Mean of the residual in one bin, over some blocks. n_k and s_k are the bin's samples and sum in block k.
struct BinMean {
  Cell all;
  double mean = 0.0;
  double worth = 0.0;    ///< effective number of blocks, (Σ n_k)² / Σ n_k²; 0: no samples
  double scatter = 0.0;  ///< Σ_k (s_k − n_k mean)²
  double weights = 0.0;  ///< Σ_k n_k²
  /// Cluster-robust variance of the mean, scatter / n² · worth / (worth − 1); NaN if worth is below 2.
  double variance() const;
};
/// Bin means over the blocks with member[block] true.
std::vector<BinMean> binMeans(const BlockTable& table, const std::vector<bool>& member);

/// Signature::share and Signature::share_sigma.
struct CrossValidated {
  double share = 0.0, sigma = 0.0;
};
/// Share of the variance that the bin means explain: fitted on each half of the blocks and scored on the
/// other. `half[block]` is the half of a block; sigma follows from the scatter between the values of
/// `segment`.
CrossValidated crossValidatedShare(const BlockTable& table, const std::vector<bool>& half,
                                   const std::vector<std::size_t>& segment);

}  // namespace capstan::diagnosis
