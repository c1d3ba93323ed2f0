#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/diagnosis/residuals/decimated_residual.h"

namespace capstan::diagnosis {

/// Number, sum of the residual and of the variable, of a set of samples.
struct Cell {
  double n = 0.0, sum = 0.0, variable = 0.0;
  Cell& operator+=(const Cell& other) {
    n += other.n, sum += other.sum, variable += other.variable;
    return *this;
  }
};

/// A channel's samples by time block and bin of a variable.
class BlockTable {
 public:
  /// `edges` rise; bin b is [edges[b], edges[b + 1]), the outermost ones reach on.
  BlockTable(std::span<const double> residual, std::span<const double> variable, const TimeBlocks& blocks,
             std::span<const double> edges);

  std::size_t bins() const { return bins_; }
  std::size_t blocks() const { return squares_.size(); }
  const Cell& at(std::size_t block, std::size_t bin) const { return cells_[block * bins_ + bin]; }
  /// Σ e² of a block.
  double squares(std::size_t block) const { return squares_[block]; }

 private:
  std::size_t bins_;
  std::vector<Cell> cells_;
  std::vector<double> squares_;
};

/// Means of bins over some blocks.
struct BinMean {
  Cell all;
  double mean = 0.0;
  double worth = 0.0;    ///< blocks, (Σ n_k)² / Σ n_k²; 0: none
  double scatter = 0.0;  ///< Σ_k (s_k − n_k mean)²
  double weights = 0.0;  ///< Σ_k n_k²
  /// Cluster-robust variance of the mean, scatter / n² · worth / (worth − 1); NaN with less than two blocks.
  double variance() const;
};
/// `member[block]`: is it one of them?
std::vector<BinMean> binMeans(const BlockTable& table, const std::vector<bool>& member);

struct CrossValidated {
  double share = 0.0, sigma = 0.0;
};
/// Signature::share: fitted on each half of the blocks, scored on the other. `half[block]` says which; scores
/// vary from `stretch[block]` to stretch.
CrossValidated crossValidatedShare(const BlockTable& table, const std::vector<bool>& half,
                                   const std::vector<std::size_t>& segment);

}  // namespace capstan::diagnosis
