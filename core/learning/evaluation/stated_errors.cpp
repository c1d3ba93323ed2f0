#include "core/learning/evaluation/stated_errors.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace capstan::learning {

void StatedErrors::add(const learning::CorrectionModel& model, const std::vector<learning::State>& states) {
  const std::vector<learning::Corrected> corrected = model.correctWithConfidence(states);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const learning::Vector6d ratios = learning::errorsInSigma(corrected[k], states[k].pair.commanded);
    for (std::size_t i = 0; i < ratio.size(); ++i)
      ratio[i].push_back(std::abs(ratios[static_cast<Eigen::Index>(i)]));
  }
}

double StatedErrors::within(std::size_t output, double sigmas) const {
  const std::vector<double>& all = ratio[output];
  if (all.empty()) return 0.0;
  const auto inside = std::count_if(all.begin(), all.end(), [&](double x) { return x <= sigmas; });
  return static_cast<double>(inside) / static_cast<double>(all.size());
}

double normalShare(double sigmas) { return std::erf(sigmas / std::numbers::sqrt2); }
double normalSigmas(double share) { return std::numbers::sqrt2 * boost::math::erf_inv(share); }

}  // namespace capstan::learning
