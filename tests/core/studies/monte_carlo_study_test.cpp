// Randomized robots and their Monte-Carlo study: draws, coverage counted by hand, resumption.
#include "core/studies/monte_carlo_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/base/yaml.h"

namespace capstan::studies {
namespace {

namespace fs = std::filesystem;

MonteCarloOptions shortStudy() {
  MonteCarloOptions options;
  options.samples = 2;
  options.duration = 60.0;
  options.seed = 5;
  options.parameters = "r_l";  // all three: with one alone, the others' errors go into the camera pose and it
  options.truth = base::resource("truth/laboratory.yaml");
  options.trajectory = "sinusoid";
  return options;
}

TEST(Worlds, AreDrawnAroundTheirCentreWithTheSpreadAskedFor) {
  const simulation::Truth centre = simulation::readTruth(base::resource("truth/laboratory.yaml"));
  RandomizationSpread spread;
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 2000;
  for (int k = 0; k < kDraws; ++k) {
    const auto sample = drawRandomizedRobot(centre, Eigen::Vector3d(0.063, 0.056, 1.0), spread,
                                            static_cast<std::uint64_t>(k));
    const double log = std::log(*sample.joints[1].link_radius / *centre.joints[1].link_radius);
    EXPECT_LE(std::abs(log), 2.0 * spread.link_radius + 1e-12);
    sum += log;
    squares += log * log;
  }
  // A normal cut off at two sigma (values beyond put onto the limit) has variance 0.9206 sigma².
  const double sigma = std::sqrt(0.9206) * spread.link_radius;
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 * sigma / std::sqrt(kDraws));
  EXPECT_NEAR(std::sqrt(squares / kDraws), sigma, 4.0 * sigma / std::sqrt(2.0 * kDraws));
}

TEST(Worlds, NoSpreadIsTheCentreAndARadiusLeftOpenIsNominal) {
  const simulation::Truth centre = simulation::matchedTruth();
  const RandomizationSpread none{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto sample = drawRandomizedRobot(centre, Eigen::Vector3d(0.063, 0.056, 1.0), none, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(sample.joints[i].stiffness_factor, centre.joints[i].stiffness_factor);
    EXPECT_DOUBLE_EQ(*sample.joints[i].link_radius, (std::array{0.063, 0.056, 1.0})[i]);
  }
  EXPECT_EQ(sample.cameras.stamp_delay, 0.0);
}

/// Worlds of one parameter of truth 1 whose intervals are value ± half, seen as said, by both methods.
struct Told {
  double value, half;
  bool seen;
};
MonteCarloStudy studyOf(const std::vector<Told>& all) {
  MonteCarloStudy study;
  study.names = {"r_l1"};
  for (const auto& [value, half, seen] : all) {
    MonteCarloEstimate one;
    one.truth = 1.0;
    one.value.fill(value);
    one.low.fill(value - half);
    one.high.fill(value + half);
    one.seen.fill(seen);
    study.samples.push_back({.seed = 0, .parameters = {one}, .seconds = {}});
  }
  return study;
}

TEST(Worlds, OnlyWorldsThatShowTheParameterCount) {
  const MonteCarloStudy study = studyOf(
      {{1.01, 0.05, true}, {0.98, 0.001, true}, {1.2, 0.05, true}, {1.0, 0.9, false}, {1.3, 0.9, false}});
  const Recovery r = study.recovery(0, experiments::Method::kBatch);
  EXPECT_EQ(r.samples, 5);
  EXPECT_EQ(r.seen, 3);
  EXPECT_EQ(r.covered, 1) << "the two priors hold the truth, and say nothing";
  EXPECT_EQ(r.covered_of_all, 3);
  EXPECT_NEAR(r.coverage(), 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(r.median_error, 0.02, 1e-12);
  // of ln(high / low) / 3.92: 0.0253, 0.00052, 0.0213
  EXPECT_NEAR(r.median_sigma, std::log(1.25 / 1.15) / 3.919928, 1e-6);
}

/// scipy.stats.beta.ppf, 95 %: 99 of 100 from 0.9455, 95 of 100 from 0.8872, 29 of 30 from 0.8278, 20 of 30
/// to 0.8271.
TEST(Worlds, TheGoalIsDecidedByTheIntervalOfTheCoverage) {
  const auto verdictOf = [](int hits, int of, int unseen) {
    std::vector<Told> all(static_cast<std::size_t>(hits), {1.0, 0.1, true});
    all.resize(static_cast<std::size_t>(of), {2.0, 0.1, true});
    all.resize(static_cast<std::size_t>(of + unseen), {1.0, 0.9, false});
    return studyOf(all).recovery(0, experiments::Method::kDualUkf).verdict();
  };
  using Verdict = Recovery::Verdict;
  EXPECT_EQ(verdictOf(99, 100, 0), Verdict::kMet);
  EXPECT_EQ(verdictOf(95, 100, 0), Verdict::kTooFew);
  EXPECT_EQ(verdictOf(29, 30, 70), Verdict::kTooFew) << "99 of 100 intervals hold the truth, 70 say nothing";
  EXPECT_EQ(verdictOf(20, 30, 70), Verdict::kMissed);
  EXPECT_EQ(verdictOf(0, 0, 100), Verdict::kUnseen);
}

TEST(Worlds, TheTableSaysWhatWasSeenNowhere) {
  MonteCarloOptions options;
  const auto rowOf = [&](const std::vector<Told>& all) {
    const base::Table table = recoveriesOf(studyOf(all), options);
    EXPECT_EQ(table.rows.size(), 2U);
    std::string row;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      row += base::cellText(table.rows[0][i], table.columns[i]) + "|";
    return row;
  };
  EXPECT_EQ(rowOf({{1.0, 0.9, false}}), "r_l1|dual UKF|0 of 1|–|–|–|–|–|–|");
  // Clopper and Pearson of 2 of 2: from √0.025; ln(1.06 / 0.96) / 3.92 = 0.02528.
  EXPECT_EQ(rowOf({{1.0, 0.9, false}, {1.01, 0.05, true}, {1.01, 0.05, true}}),
            "r_l1|dual UKF|2 of 3|2 of 2|100 %|16–100 %|too few|1.000|2.528|");
}

TEST(Worlds, AStudyGoesOnWhereItWasStoppedAndFindsThePulley) {
  const fs::path folder = fs::path(testing::TempDir()) / "capstan_monte_carlo";
  fs::remove_all(folder);
  MonteCarloOptions options = shortStudy();
  options.out = folder;
  options.samples = 1;
  base::Progress first;
  ASSERT_EQ(runMonteCarloStudy(options, first).samples.size(), 1U);
  const auto written = fs::last_write_time(folder / "samples" / "sample-5.json");
  options.samples = 2;
  base::Progress second;
  const MonteCarloStudy study = runMonteCarloStudy(options, second);
  ASSERT_EQ(study.samples.size(), 2U);
  EXPECT_EQ(fs::last_write_time(folder / "samples" / "sample-5.json"), written) << "not run again";
  for (const RandomizedRobot& sample : study.samples) {
    const MonteCarloEstimate& radius = sample.parameters.at(0);
    EXPECT_NE(radius.truth, 0.063095);
    for (const double value : radius.value) EXPECT_NEAR(value / radius.truth, 1.0, 0.01);
  }
  fs::remove_all(folder);
}

TEST(Worlds, AWorldOfAnotherProgramIsRunAgain) {
  const fs::path folder = fs::path(testing::TempDir()) / "capstan_monte_carlo_again";
  fs::remove_all(folder);
  MonteCarloOptions options = shortStudy();
  options.out = folder;
  options.samples = 1;
  options.duration = 20.0;
  base::Progress first;
  EXPECT_TRUE(runMonteCarloStudy(options, first).notices.empty());
  const fs::path file = folder / "samples" / "sample-5.json";
  const auto document = nlohmann::json::parse(base::readTextFile(file));
  EXPECT_THAT(document.at("fingerprint").at("software"), testing::StartsWith("capstan "));
  for (const char* part : {"software", "identification", "nominal robot"}) {
    auto other = document;
    other["fingerprint"][part] = "another";
    base::writeTextFile(file, other.dump());
    base::Progress again;
    const MonteCarloStudy study = runMonteCarloStudy(options, again);
    ASSERT_EQ(study.notices.size(), 1U) << part;
    EXPECT_THAT(study.notices[0], testing::HasSubstr(part));
    EXPECT_THAT(study.notices[0], testing::HasSubstr("sample-5.json"));
    EXPECT_EQ(nlohmann::json::parse(base::readTextFile(file)).at("fingerprint"), document.at("fingerprint"));
  }
  fs::remove_all(folder);
}

TEST(Worlds, CancellingKeepsWhatIsDone) {
  base::Progress progress;
  progress.cancel();
  const MonteCarloStudy study = runMonteCarloStudy(shortStudy(), progress);
  EXPECT_TRUE(study.cancelled);
  EXPECT_TRUE(study.samples.empty());
}

TEST(Worlds, UnknownParametersAreRefused) {
  MonteCarloOptions options = shortStudy();
  options.parameters = "r_l9";
  base::Progress progress;
  EXPECT_THROW(runMonteCarloStudy(options, progress), base::InputError);
}

}  // namespace
}  // namespace capstan::studies
