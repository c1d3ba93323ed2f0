#pragma once

#include <cstddef>
#include <span>

namespace capstan::stats {

/// Block length of a circular block bootstrap with the smallest error of the variance of the mean, estimated
/// from the autocorrelation of the samples (Politis and White 2004, corrected by Patton, Politis and White
/// 2009):
///
///     b = (2 G² / D)^(1/3) n^(1/3),  D = 4/3 g²,  G = Σ λ(k/M) |k| R_k,  g = Σ λ(k/M) R_k,  |k| ≤ M,
///
/// with R_k the autocovariances, λ(x) = 1 up to |x| = 1/2 and 2 (1 − |x|) up to 1, and M twice the lag after
/// which five (or √log10 n) consecutive correlations are below 2 √(log10 n / n). The result is at least 1 and
/// at most min(3 √n, n/3); it is 1 when all samples are equal. The samples are equally spaced in time. Throws
/// base::InputError when there are no samples or one is not finite.
std::size_t optimalBlockLength(std::span<const double> values);

}  // namespace capstan::stats
