#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace capstan::diagnosis {

/// Position at row `begin` and slope of a column, from a line fitted to its rows [begin, end). `step`: time
/// between rows [s]. NaN where no row is finite.
std::pair<double, double> lineAround(const std::vector<double>& column, std::size_t begin, std::size_t end,
                                     double step);

/// The same from a fitted parabola, which gives the accurate start that a long simulation needs.
std::pair<double, double> parabolaFrom(const std::vector<double>& column, std::size_t begin, std::size_t end,
                                       double step);

}  // namespace capstan::diagnosis
