#pragma once

namespace capstan::stats {

/// Quantile of the χ² distribution with `dof` ≥ 1 degrees of freedom, `probability` in (0, 1).
double chiSquareQuantile(int dof, double probability);

}  // namespace capstan::stats
