#pragma once

#include <span>
#include <vector>

namespace capstan::diagnosis {

/// Equally spaced readings of a smooth quantity without their sensor noise: Whittaker's smoother (1923;
/// Eilers, Analytical Chemistry 75, 2003),
///     argmin_x Σ (y_k − x_k)² + λ Σ (Δ³ x_k)².
/// λ is about the largest value at which the RMS of y − x over 50 readings is at most 1.1 times the noise in
/// nine of ten segments, and at most twice the noise in all (discrepancy principle, Morozov 1966). `noise` is
/// the standard deviation of a reading, quantisation included. With noise 0 or fewer than 8 readings, the
/// readings are returned unchanged. All readings must be finite.
std::vector<double> smoothReadings(std::span<const double> readings, double noise);

}  // namespace capstan::diagnosis
