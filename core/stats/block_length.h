#pragma once

#include <cstddef>
#include <span>

namespace capstan::stats {

/// The length of a circular block bootstrap's blocks that makes the error of the mean's variance least, from
/// the samples' own correlation (Politis and White 2004, corrected by Patton, Politis and White 2009):
///
///     b = (2 G² / D)^(1/3) n^(1/3),  D = 4/3 g²,  G = Σ λ(k/M) |k| R_k,  g = Σ λ(k/M) R_k,  |k| ≤ M,
///
/// R_k the autocovariances, λ(x) = 1 up to |x| = 1/2 and 2 (1 − |x|) up to 1, M twice the lag after which
/// five (or √log10 n) correlations in a row are below 2 √(log10 n / n). At most min(3 √n, n/3), at least 1.
/// Samples equally spaced; all the same: 1. base::InputError: no samples, or one that is not finite.
std::size_t optimalBlockLength(std::span<const double> values);

}  // namespace capstan::stats
