#include "core/diagnosis/evidence/evidence.h"

#include <algorithm>
#include <cmath>

namespace capstan::diagnosis {

double ChannelNoise::floor() const { return std::max(sigma, step / std::sqrt(12.0)); }

std::size_t Evidence::countingRows() const {
  return static_cast<std::size_t>(std::count(exclusions.begin(), exclusions.end(), 0));
}

std::size_t Evidence::countingObservations() const {
  return static_cast<std::size_t>(std::count_if(
      tip.begin(), tip.end(), [](const TipObservation& observation) { return observation.counts; }));
}

double Evidence::duration() const {
  double sum = 0.0;
  for (const Segment& segment : segments)
    if (segment.size() > 1) sum += step * static_cast<double>(segment.size() - 1);
  return sum;
}

double Evidence::at(const std::vector<double>& column, double row) {
  const auto before = std::min(static_cast<std::size_t>(row), column.size() - 1);
  const double part = row - static_cast<double>(before);
  if (part <= 0.0 || before + 1 >= column.size()) return column[before];
  return column[before] + part * (column[before + 1] - column[before]);
}

}  // namespace capstan::diagnosis
