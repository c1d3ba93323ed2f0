#include "core/identification/live_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/shown_number.h"

namespace capstan::identification {
namespace {

bool inKilonewtons(const Parameter& parameter) {
  return parameter.quantity == Quantity::kStiffness && parameter.nominal >= 1e3;
}

/// Number of decimals that show two digits of `sigma`.
int decimalsFor(double sigma) {
  return sigma > 0.0 ? std::clamp(base::significantDecimals(sigma, 2), 0, 6) : 2;
}

}  // namespace

double scaleOf(const Parameter& parameter) { return inKilonewtons(parameter) ? 1e-3 : parameter.scale(); }

std::string unitOf(const Parameter& parameter) { return inKilonewtons(parameter) ? "kN" : parameter.unit(); }

LiveRow rowOf(const Parameter& parameter) {
  LiveRow row;
  row.name = parameter.name();
  row.value = "—";
  row.unit = unitOf(parameter);
  row.words = parameter.words() + " has no estimate yet";
  return row;
}

LiveRow rowOf(const Estimate& estimate, const Convergence* convergence, double change) {
  const Parameter& parameter = estimate.parameter;
  LiveRow row = rowOf(parameter);
  const double way = std::log(parameter.prior_sigma / parameter.goal);
  row.share = way > 0.0 ? std::clamp(std::log(parameter.prior_sigma / estimate.sigma) / way, 0.0, 1.0) : 1.0;
  row.seen = estimate.seen;
  row.settled = convergence ? convergence->settled : estimate.seen && estimate.sigma <= parameter.goal;
  if (convergence)
    row.words = wordsOf(*convergence, estimate);
  else if (!estimate.advice.empty())
    row.words = estimate.advice;
  else
    row.words =
        fmt::format("{} has a standard deviation of {:.2g} %", parameter.words(), 100.0 * estimate.sigma);
  if (!estimate.seen) {
    row.value = "not observable";
    return row;
  }
  const double sigma = scaleOf(parameter) * estimate.valueSigma();
  row.value = fmt::format("{:.{}f}", scaleOf(parameter) * estimate.value(), decimalsFor(sigma));
  row.sigma = fmt::format("±{:.{}f}", sigma, decimalsFor(sigma));
  const bool rounds_to_zero = std::abs(change) < 0.05;  // shown without a sign
  row.change = rounds_to_zero ? "0.0 %" : base::withMinus(fmt::format("{:+.1f} %", change));
  return row;
}

}  // namespace capstan::identification
