#include "core/stats/boxplot.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/stats/quantile.h"
#include "core/stats/samples.h"

namespace capstan::stats {

Boxplot boxplot(std::span<const double> values, double reach) {
  requireSamples(values, 1, "boxplot");
  if (!(reach >= 0.0))
    throw base::InputError(
        {{}, 0, "reach", fmt::format("{}", reach), "must be 0 or more", "Give it in interquartile ranges"});
  const double shares[] = {0.25, 0.5, 0.75};
  const std::vector<double> quartiles = quantiles(values, shares);

  Boxplot box{.n = values.size(),
              .lower_whisker = quartiles[0],
              .first_quartile = quartiles[0],
              .median = quartiles[1],
              .third_quartile = quartiles[2],
              .upper_whisker = quartiles[2],
              .outliers = {}};
  const double fence = reach * box.interquartileRange();
  for (const double x : values) {
    if (x < box.first_quartile - fence || x > box.third_quartile + fence) {
      box.outliers.push_back(x);
    } else {
      box.lower_whisker = std::min(box.lower_whisker, x);
      box.upper_whisker = std::max(box.upper_whisker, x);
    }
  }
  std::sort(box.outliers.begin(), box.outliers.end());
  return box;
}

}  // namespace capstan::stats
