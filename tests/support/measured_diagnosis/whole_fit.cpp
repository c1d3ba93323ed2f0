#include "tests/support/measured_diagnosis/whole_fit.h"

namespace capstan::measured {

using diagnosis::Evidence, diagnosis::Fit, diagnosis::FitData, diagnosis::Weighting;

Fit wholeFit(const std::vector<Evidence>& recordings, const robot::Description& robot, const Fit& chosen,
             diagnosis::EncoderZeros zeros, int threads) {
  constexpr int kPasses = 3;  // weights go by what is left
  const FitData data(recordings, robot, 0.0, zeros, threads);
  Weighting weighting{Eigen::VectorXd::Ones(data.size())};
  Fit found = linearise(data, chosen.model, chosen.u, noneBeyond(data), weighting);
  for (int pass = 0; pass < kPasses; ++pass) {
    weighting.weights = weightsFor(data, found.e);
    found = fit(data, found.model, found.u, found.initial, weighting, {20, 0.01, nullptr});
  }
  return found;
}

}  // namespace capstan::measured
