#pragma once

#include <span>
#include <vector>

namespace capstan::diagnosis {

/// Equally spaced readings of something smooth, less what its sensor adds: Whittaker's
/// smoother (1923; Eilers, Analytical Chemistry 75, 2003),
///     argmin_x Σ (y_k − x_k)² + λ Σ (Δ³ x_k)²,
/// with about the largest λ at which nine in ten segments of readings are left by no more than their noise
/// and none by more than twice it (discrepancy principle, Morozov 1966). `noise`: standard deviation of a
/// reading, quantisation in it; 0 or fewer than 8 readings: as they are. All finite.
std::vector<double> smoothReadings(std::span<const double> readings, double noise);

}  // namespace capstan::diagnosis
