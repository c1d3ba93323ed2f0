#include "tests/support/measured_diagnosis/jaw.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "tests/support/measured_diagnosis/steps.h"
#include "tests/support/measured_diagnosis/whole_fit.h"

namespace capstan::measured {
namespace {

using Recordings = std::vector<diagnosis::Evidence>;

Recordings recordingsAt(int first_level, const std::filesystem::path& folder,
                        const std::vector<std::string>& frequencies, const robot::Description& robot) {
  diagnosis::EvidenceOptions options;
  options.skip_start = 1.0;
  Recordings all;
  for (const std::string& frequency : frequencies)
    for (int level = first_level; level < 10; level += 2)
      all.push_back(diagnosis::readEvidence(
          folder / fmt::format("tool4_left_{}Hz_load{}.csv", frequency, level), robot, options));
  return all;
}

/// What the fit's model leaves of recordings.
Eigen::VectorXd left(const diagnosis::FitData& data, const diagnosis::Fit& fit) {
  const diagnosis::Weighting weighting{Eigen::VectorXd::Ones(data.size())};
  return diagnosis::linearise(data, fit.model, fit.u, diagnosis::noneBeyond(data), weighting).e;
}

double rmsInDegrees(const Eigen::VectorXd& e) {
  return std::sqrt(e.squaredNorm() / static_cast<double>(e.size())) * 180.0 / std::numbers::pi;
}

}  // namespace

std::vector<JawStep> jawSteps(const std::filesystem::path& folder,
                              const std::vector<std::string>& frequencies,
                              const diagnosis::SearchOptions& options, int threads) {
  const robot::Description nominal = robotFile("jaw.yaml");
  const Recordings even = recordingsAt(0, folder, frequencies, nominal);
  const Recordings odd = recordingsAt(1, folder, frequencies, nominal);
  using diagnosis::EncoderZeros;
  const diagnosis::FitData fitted(even, nominal, 0.0, EncoderZeros::kOneForAll, threads);
  const diagnosis::FitData even_known(even, nominal, 0.0, EncoderZeros::kKnown, threads);
  const diagnosis::FitData odd_known(odd, nominal, 0.0, EncoderZeros::kKnown, threads);
  const diagnosis::FitData odd_each(odd, nominal, 0.0, EncoderZeros::kOnePerRecording, threads);
  const diagnosis::FitModel base(nominal, diagnosis::jointScales(even, nominal));
  std::vector<JawStep> steps;
  for (const Step& step : stepsOf(fitted, diagnosis::select(fitted, even, base, nullptr, options, nullptr))) {
    const diagnosis::Fit whole = wholeFit(even, nominal, step.fit, EncoderZeros::kOneForAll, threads);
    const Eigen::VectorXd told = left(even_known, whole);
    steps.push_back({step.name, step.competitors, whole.model.extended(whole.u),
                     rmsInDegrees((told.array() - told.mean()).matrix()),
                     rmsInDegrees((left(odd_known, whole).array() - told.mean()).matrix()),
                     rmsInDegrees(left(odd_each, whole))});
  }
  return steps;
}

}  // namespace capstan::measured
