// The progress of a search follows its simulations.
#include "core/diagnosis/selection/search_progress.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/set_fit.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

TEST(SearchProgress, GrowsWithEveryPartOfASimulation) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
  base::Progress progress;
  progress.report(0.1, "before");
  SearchProgress shown(data, planted.evidence, &progress, 0.7, 1e12);
  shown.report("refitting");
  EXPECT_EQ(progress.fraction(), 0.1);
  EXPECT_EQ(progress.doing(), "refitting");
  SetFitter(data).nominal(nominal, Eigen::VectorXd::Zero(nominal.size()));
  const double first = progress.fraction();
  EXPECT_GT(first, 0.12) << "also within a fit";
  EXPECT_LT(first, 0.6);
  shown.beginStep(2);
  SetFitter(data).nominal(nominal, Eigen::VectorXd::Zero(nominal.size()));
  EXPECT_NEAR((progress.fraction() - first) / (0.7 - first), 1.0 / 6.0, 0.04)
      << "an expansion of five times the fit is expected, and a fit";
}

TEST(SearchProgress, CountsAllWorkOfASimulationOnce) {
  const Planted planted(1);
  const FitData data(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2);
  const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
  std::vector<double> seen;
  data.onWork([&seen](double work) { seen.push_back(work); });
  const robot::ChainModel model = nominal.chain(Eigen::VectorXd::Zero(nominal.size()));
  data.simulate(std::vector<robot::ChainModel>(20, model));
  ASSERT_GT(seen.size(), 1U);
  for (std::size_t k = 1; k < seen.size(); ++k) EXPECT_GT(seen[k], seen[k - 1]);
  EXPECT_NEAR(seen.back(), data.work(), 1e-9 * data.work());
}

}  // namespace
}  // namespace capstan::diagnosis
