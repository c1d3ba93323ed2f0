#include "core/analysis/analysis.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/stats/block_length.h"
#include "core/stats/bootstrap.h"
#include "core/stats/quantile.h"
#include "core/stats/rms.h"

namespace capstan::analysis {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Errors that follow x_t = φ x_{t−1} + noise of one degree (or one millimetre) RMS times `size`; the UKF's
/// are half the kinematic ones plus noise of a tenth. Every second second is occluded.
ErrorRun runOf(std::uint64_t seed, double size, std::size_t n = 4000, const std::string& motion = "one") {
  constexpr double kPhi = 0.8;
  const Eigen::Vector3d unit(kDegree, kDegree, 1e-3);
  base::Random random(seed, "errors");
  ErrorRun run{.title = "run " + std::to_string(seed), .motion = motion};
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Vector3d small;
    for (int k = 0; k < 3; ++k) {
      x(k) = kPhi * x(k) + std::sqrt(1.0 - kPhi * kPhi) * random.normal();
      small(k) = 0.1 * random.normal();
    }
    const double t = 0.01 * static_cast<double>(i);
    const Eigen::Vector3d kinematic = size * x.cwiseProduct(unit);
    run.errors.push_back(
        {t, kinematic, kinematic, size * (0.5 * x + small).cwiseProduct(unit), i % 200 >= 100});
    if (i % 7 == 0) run.camera.push_back({t, experiments::noJoints(), 0.2 * size * x.cwiseProduct(unit)});
  }
  run.begin = run.errors.front().t;
  run.end = run.errors.back().t;
  return run;
}

const AnalysisRow& rowOf(const Analysis& analysis, int joint, experiments::Estimator estimator) {
  for (const AnalysisRow& row : analysis.rows)
    if (row.joint == joint && row.estimator == estimator) return row;
  throw std::logic_error("no such row");
}

TEST(Analysis, SelectsJointTimeAndUnit) {
  ErrorRun run{.title = "two points"};
  run.errors.push_back({0.0, {-0.1, 0.2, 3e-3}, {9, 9, 9}, {0.01, 0.02, -4e-3}, false});
  run.errors.push_back({0.01, {0.3, NAN, 5e-3}, {9, 9, 9}, {0.03, 0.04, 6e-3}, true});
  run.camera.push_back({0.004, experiments::noJoints(), {0.5, 0.6, 7e-3}});
  AnalysisOptions options;
  const auto values = [&](experiments::Estimator estimator, int joint) {
    return selectedErrors(run, estimator, joint, options).value;
  };
  using Numbers = std::vector<double>;
  EXPECT_THAT(values(experiments::Estimator::kKinematic, 0),
              ::testing::Pointwise(::testing::DoubleNear(1e-12), Numbers{-0.1 / kDegree}));
  // One joint of the other is not known: it is excluded as a whole, as in the table of errors.
  EXPECT_EQ(values(experiments::Estimator::kKinematic, 1).size(), 1U);
  EXPECT_EQ(values(experiments::Estimator::kUkf, 2), (Numbers{-4.0, 6.0}));
  EXPECT_EQ(values(experiments::Estimator::kCamera, 2), Numbers{7.0});
  options.absolute = true;
  EXPECT_EQ(values(experiments::Estimator::kUkf, 2), (Numbers{4.0, 6.0}));
  options.share = TimeShare::kOccluded;
  EXPECT_EQ(values(experiments::Estimator::kUkf, 2), Numbers{6.0});
  EXPECT_TRUE(values(experiments::Estimator::kCamera, 2).empty());
  options.share = TimeShare::kVisible;
  EXPECT_EQ(values(experiments::Estimator::kUkf, 2), Numbers{4.0});
  EXPECT_EQ(values(experiments::Estimator::kCamera, 2), Numbers{7.0});
}

TEST(Analysis, NumbersAreThoseOfStats) {
  const ErrorRun run = runOf(1, 1.0);
  AnalysisOptions options;
  options.estimators = {experiments::Estimator::kKinematic, experiments::Estimator::kCamera,
                        experiments::Estimator::kUkf};
  const Analysis analysis = analyse(run, nullptr, options);
  ASSERT_EQ(analysis.rows.size(), 9U);
  EXPECT_EQ(analysis.against, Against::kKinematic);
  for (const AnalysisRow& row : analysis.rows) {
    const auto values = selectedErrors(run, row.estimator, row.joint, options).value;
    EXPECT_EQ(row.a.n, values.size());
    EXPECT_EQ(row.a.of(Measure::kRms), stats::rms(values));
    EXPECT_EQ(row.a.of(Measure::kMedian), stats::median(values));
    EXPECT_EQ(row.a.of(Measure::kInterquartileRange),
              stats::quantile(values, 0.75) - stats::quantile(values, 0.25));
    EXPECT_EQ(row.a.of(Measure::kMean), stats::mean(values));
    EXPECT_EQ(row.b.n, 0U);
    EXPECT_EQ(std::isfinite(row.of(Measure::kRms).value), row.estimator == experiments::Estimator::kUkf);
  }
  const AnalysisRow& ukf = rowOf(analysis, 1, experiments::Estimator::kUkf);
  EXPECT_EQ(
      ukf.of(Measure::kRms).value,
      ukf.a.of(Measure::kRms) - rowOf(analysis, 1, experiments::Estimator::kKinematic).a.of(Measure::kRms));
}

// RMS and mean count what memory did not keep; median and IQR say how many they are of.
TEST(Analysis, EverySampleCountsAndWhatWasThinnedIsSaid) {
  ErrorRun run = runOf(1, 1.0);
  run.kinematic_robot = run.filter_robot = "mine.yaml";
  for (const experiments::ErrorPoint& point : run.errors) {
    run.addMoments(experiments::Estimator::kKinematic, point.kinematic, point.occluded);
    run.addMoments(experiments::Estimator::kUkf, point.ukf, point.occluded);
  }
  const ErrorRun whole = run;
  for (std::size_t i = 0; 10 * i < run.errors.size(); ++i) run.errors[i] = run.errors[10 * i];
  run.errors.resize(400);
  AnalysisOptions options;
  options.joint = 0;
  for (const TimeShare share : {TimeShare::kAll, TimeShare::kOccluded, TimeShare::kVisible}) {
    options.share = share;
    const Analysis all = analyse(whole, nullptr, options), thinned = analyse(run, nullptr, options);
    const ErrorSummary &a = all.rows.at(1).a, &b = thinned.rows.at(1).a;
    const std::size_t n = share == TimeShare::kAll ? 4000 : 2000;
    EXPECT_EQ(a.count(Measure::kMedian), n);
    EXPECT_EQ(b.n, n);
    EXPECT_EQ(b.count(Measure::kMean), n);
    EXPECT_EQ(b.count(Measure::kMedian), n / 10);
    EXPECT_EQ(b.of(Measure::kRms), a.of(Measure::kRms));
    EXPECT_EQ(b.of(Measure::kMean), a.of(Measure::kMean));
    EXPECT_NE(b.of(Measure::kMedian), a.of(Measure::kMedian));
    EXPECT_NEAR(a.of(Measure::kRms),
                stats::rms(selectedErrors(whole, experiments::Estimator::kUkf, 0, options).value), 1e-12);
    EXPECT_EQ(thinningWords(all), "");
    EXPECT_EQ(thinningWords(thinned), fmt::format("distributions of {} of {} samples", n / 10, n));
    EXPECT_THAT(tableOf(thinned).note, HasSubstr(fmt::format("of {} of {} samples", n / 10, n)));
    EXPECT_THAT(tableOf(thinned).note, HasSubstr("kinematics and UKF of mine.yaml"));
    EXPECT_THAT(tableOf(all).note, HasSubstr("Every sample counts."));
  }
  const Analysis two = analyse(whole, &run, options);
  EXPECT_EQ(thinningWords(two), "distributions of B: 200 of 2000 samples");
  EXPECT_THAT(runWords(two), ::testing::ElementsAre("A: run 1, kinematics and UKF of mine.yaml, n = 2000",
                                                    "B: run 1, kinematics and UKF of mine.yaml, n = 2000"));
  run.kinematic_robot = "RAVEN-II left (nominal)";
  EXPECT_EQ(analyse(run, nullptr, options).robots_a,
            "kinematics of RAVEN-II left (nominal), UKF of mine.yaml");
}

TEST(Analysis, OfARunWithItselfHasNoDifference) {
  const ErrorRun run = runOf(2, 1.0);
  AnalysisOptions options;
  options.resamples = 50;
  Analysis analysis = analyse(run, &run, options);
  base::Progress progress;
  ASSERT_TRUE(addIntervals(analysis, run, &run, progress));
  EXPECT_TRUE(analysis.intervals);
  for (const AnalysisRow& row : analysis.rows) {
    EXPECT_TRUE(row.paired);
    EXPECT_TRUE(std::isnan(row.p));  // nothing spreads
    for (const Measure measure : kMeasures) {
      EXPECT_EQ(row.of(measure).value, 0.0);
      EXPECT_EQ(row.of(measure).low, 0.0);
      EXPECT_EQ(row.of(measure).high, 0.0);
      EXPECT_FALSE(row.of(measure).clear());
    }
  }
}

// The oracle is the plain path: the same bootstrap with the statistics that sort.
TEST(Analysis, TheFilterIsNotComparedWithTheKinematicsThatAreTheReference) {
  ErrorRun run = runOf(1, 1.0);
  EXPECT_EQ(analyse(run, nullptr, {}).against, Against::kKinematic);
  run.own_kinematics = true;
  const Analysis analysis = analyse(run, nullptr, {});
  EXPECT_EQ(analysis.against, Against::kNothing);
  for (const AnalysisRow& row : analysis.rows) EXPECT_TRUE(std::isnan(row.of(Measure::kRms).value));
}

TEST(Analysis, IntervalsAreThoseOfTheBlockBootstrap) {
  const ErrorRun a = runOf(3, 1.0, 1500), b = runOf(4, 1.4, 1400, "two");
  AnalysisOptions options;
  options.joint = 1;
  options.resamples = 60;
  options.estimators = {experiments::Estimator::kUkf};
  Analysis analysis = analyse(a, &b, options);
  base::Progress progress;
  ASSERT_TRUE(addIntervals(analysis, a, &b, progress));
  EXPECT_EQ(progress.fraction(), 1.0);
  const AnalysisRow& row = analysis.rows.at(0);
  EXPECT_FALSE(row.paired);
  const auto first = selectedErrors(a, experiments::Estimator::kUkf, 1, options).value;
  const auto second = selectedErrors(b, experiments::Estimator::kUkf, 1, options).value;
  EXPECT_GE(row.block_length, stats::optimalBlockLength(first));
  const stats::Statistic statistics[] = {
      stats::rms, stats::median,
      [](std::span<const double> x) { return stats::quantile(x, 0.75) - stats::quantile(x, 0.25); },
      stats::mean};
  for (std::size_t i = 0; i < kMeasures.size(); ++i) {
    base::Random random(options.seed, "analysis");
    const auto report = stats::bootstrapDifference(
        second, first, statistics[i], {.block_length = row.block_length, .resamples = 60}, random);
    EXPECT_NEAR(row.difference[i].value, report.estimate, 1e-12);
    EXPECT_NEAR(row.difference[i].low, report.interval.low, 1e-12);
    EXPECT_NEAR(row.difference[i].high, report.interval.high, 1e-12);
  }
}

ErrorRun everyOther(const ErrorRun& run) {
  ErrorRun half = run;
  half.errors.clear();
  for (std::size_t i = 0; i < run.errors.size(); i += 2) half.errors.push_back(run.errors[i]);
  return half;
}

// A session that ran for long keeps every other sample: at those instants the two are one.
TEST(Analysis, RunsOfOneMotionPairAtTheInstantsThatBothHave) {
  const ErrorRun a = runOf(11, 1.0), b = everyOther(a);
  AnalysisOptions options;
  options.resamples = 50;
  base::Progress progress;
  for (const bool swapped : {false, true}) {
    const ErrorRun &first = swapped ? b : a, &second = swapped ? a : b;
    Analysis analysis = analyse(first, &second, options);
    ASSERT_TRUE(addIntervals(analysis, first, &second, progress));
    for (const AnalysisRow& row : analysis.rows) {
      EXPECT_TRUE(row.paired);
      for (const Difference& one : row.difference) {
        EXPECT_EQ(one.low, 0.0);
        EXPECT_EQ(one.high, 0.0);
      }
    }
  }
}

// The oracle is the bootstrap of both sides by hand: every other sample of the quicker run, cut where time
// was not selected (a second in two, so that pieces have 50 samples).
TEST(Analysis, SidesHaveOneSpacingAndNoBlockAcrossGaps) {
  const ErrorRun a = runOf(12, 1.0, 4000), thinned = everyOther(a);
  const ErrorRun b = everyOther(runOf(13, 1.3, 3600, "two"));
  AnalysisOptions options;
  options.joint = 0;
  options.resamples = 60;
  options.estimators = {experiments::Estimator::kKinematic};
  options.share = TimeShare::kOccluded;
  Analysis analysis = analyse(a, &b, options);
  base::Progress progress;
  ASSERT_TRUE(addIntervals(analysis, a, &b, progress));
  const AnalysisRow& row = analysis.rows.at(0);
  EXPECT_FALSE(row.paired);
  EXPECT_LT(row.block_length, 50U);
  const auto first = selectedErrors(thinned, experiments::Estimator::kKinematic, 0, options).value;
  const auto second = selectedErrors(b, experiments::Estimator::kKinematic, 0, options).value;
  ASSERT_EQ(first.size(), 20U * 50U);
  ASSERT_EQ(second.size(), 18U * 50U);
  base::Random random(options.seed, "analysis");
  const auto report = stats::bootstrapDifference(second, first, stats::rms,
                                                 {.block_length = row.block_length,
                                                  .resamples = 60,
                                                  .pieces = stats::Pieces(18, 50),
                                                  .second_pieces = stats::Pieces(20, 50)},
                                                 random);
  EXPECT_NEAR(row.of(Measure::kRms).low, report.interval.low, 1e-12);
  EXPECT_NEAR(row.of(Measure::kRms).high, report.interval.high, 1e-12);
  EXPECT_EQ(row.blocks, 18U * (50U / row.block_length)) << "no block of the test of means straddles, too";
}

// Of two independent runs whose true RMS differ by 0.5 and by nothing: 95 % intervals that hold the truth in
// fewer than 88 of 100 draws have a probability below 0.002.
TEST(Analysis, IntervalsCoverTheTruth) {
  for (const double size : {1.5, 1.0}) {
    int covered = 0, clear = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const ErrorRun a = runOf(1000 + 2 * seed, 1.0, 1500), b = runOf(1001 + 2 * seed, size, 1500, "two");
      AnalysisOptions options;
      options.joint = 2;
      options.estimators = {experiments::Estimator::kKinematic};
      options.resamples = 200;
      Analysis analysis = analyse(a, &b, options);
      base::Progress progress;
      ASSERT_TRUE(addIntervals(analysis, a, &b, progress));
      const Difference& rms = analysis.rows[0].of(Measure::kRms);
      covered += rms.low <= size - 1.0 && size - 1.0 <= rms.high ? 1 : 0;
      clear += rms.clear() ? 1 : 0;
    }
    EXPECT_GE(covered, 88) << size;
    EXPECT_LE(clear, size > 1.0 ? 100 : 12);
    EXPECT_GE(clear, size > 1.0 ? 100 : 0);
  }
}

TEST(Analysis, PairsOfOneMotionAreTighter) {
  const ErrorRun a = runOf(5, 1.0), b = runOf(5, 1.1);
  ErrorRun other = b;
  other.motion = "another";
  AnalysisOptions options;
  options.resamples = 300;
  options.joint = 0;
  Analysis paired = analyse(a, &b, options), apart = analyse(a, &other, options);
  base::Progress progress;
  ASSERT_TRUE(addIntervals(paired, a, &b, progress));
  ASSERT_TRUE(addIntervals(apart, a, &other, progress));
  const Difference& tight = paired.rows[0].of(Measure::kRms);
  const Difference& wide = apart.rows[0].of(Measure::kRms);
  EXPECT_TRUE(paired.rows[0].paired);
  EXPECT_FALSE(apart.rows[0].paired);
  EXPECT_EQ(tight.value, wide.value);
  EXPECT_LT(tight.high - tight.low, 0.3 * (wide.high - wide.low));
  EXPECT_TRUE(tight.clear());
}

// Of equal means P is uniform: five or more of 60 below 0.01 have a probability below 0.001. Means a third of
// a deviation apart are distinguished for certain.
TEST(Analysis, ProbabilityKnowsOfCorrelation) {
  int small = 0;
  AnalysisOptions options;
  options.joint = 0;
  options.estimators = {experiments::Estimator::kKinematic};
  options.resamples = 2;
  base::Progress progress;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const ErrorRun a = runOf(3000 + 2 * seed, 1.0), b = runOf(3001 + 2 * seed, 1.0, 4000, "two");
    Analysis analysis = analyse(a, &b, options);
    ASSERT_TRUE(addIntervals(analysis, a, &b, progress));
    ASSERT_TRUE(std::isfinite(analysis.rows[0].p));
    small += analysis.rows[0].p < 0.01 ? 1 : 0;
  }
  EXPECT_LE(small, 4);
  const ErrorRun a = runOf(7, 1.0);
  ErrorRun b = runOf(8, 1.0, 4000, "two");
  for (experiments::ErrorPoint& point : b.errors) point.kinematic(0) += 0.33 * kDegree;
  Analysis analysis = analyse(a, &b, options);
  ASSERT_TRUE(addIntervals(analysis, a, &b, progress));
  EXPECT_LT(analysis.rows[0].p, 1e-4);
}

TEST(Analysis, CancelLeavesItAsItWas) {
  const ErrorRun run = runOf(6, 1.0);
  Analysis analysis = analyse(run, nullptr, {});
  base::Progress progress;
  progress.cancel();
  EXPECT_FALSE(addIntervals(analysis, run, nullptr, progress));
  EXPECT_FALSE(analysis.intervals);
  EXPECT_TRUE(std::isnan(rowOf(analysis, 0, experiments::Estimator::kUkf).of(Measure::kRms).low));
}

TEST(Analysis, SaysWhereNothingIsLeft) {
  ErrorRun run = runOf(9, 1.0, 50);  // all of it seen
  AnalysisOptions options;
  options.share = TimeShare::kOccluded;
  try {
    analyse(run, nullptr, options);
    FAIL() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("run 9"));
    EXPECT_THAT(error.what(), HasSubstr("occluded"));
  }
  options.share = TimeShare::kAll;
  options.estimators.clear();
  EXPECT_THROW(analyse(run, nullptr, options), base::InputError);
}

TEST(Analysis, SmallErrorsKeepTheirDigits) {
  Analysis analysis;
  EXPECT_EQ(decimalsOf(analysis), 3);
  analysis.rows.resize(2);
  analysis.rows[0].a = summaryOf({2.0, -2.0});
  EXPECT_EQ(decimalsOf(analysis), 3);
  analysis.rows[1].b = summaryOf({0.0061, -0.0061});
  EXPECT_EQ(decimalsOf(analysis), 5);
  analysis.rows[1].b = summaryOf({1e-12});
  EXPECT_EQ(decimalsOf(analysis), 6);
}

TEST(Analysis, TableHoldsWhatWasFound) {
  const ErrorRun a = runOf(10, 1.0, 2000), b = runOf(11, 1.5, 2000, "two");
  AnalysisOptions options;
  options.resamples = 50;
  options.joint = 2;
  Analysis analysis = analyse(a, &b, options);
  base::Progress progress;
  ASSERT_TRUE(addIntervals(analysis, a, &b, progress));
  const base::Table table = tableOf(analysis);
  ASSERT_EQ(table.rows.size(), 8U);  // two estimators, four measures
  for (const auto& row : table.rows) ASSERT_EQ(row.size(), table.columns.size());
  const AnalysisRow& ukf = rowOf(analysis, 2, experiments::Estimator::kUkf);
  const auto& cells = table.rows[7];
  EXPECT_EQ(cells[1].text, "UKF");
  EXPECT_EQ(cells[2].text, "mean");
  EXPECT_EQ(cells[3].text, "mm");
  EXPECT_EQ(cells[4].number, ukf.a.of(Measure::kMean));
  EXPECT_EQ(cells[5].number, ukf.b.of(Measure::kMean));
  EXPECT_EQ(cells.back().number, ukf.p);
  EXPECT_THAT(table.note, HasSubstr("A: run 10, n = 2000. B: run 11, n = 2000."));
  EXPECT_EQ(probabilityText(0.0341, std::log10(0.0341)), "0.034");
  EXPECT_EQ(probabilityText(1.23e-5, std::log10(1.23e-5)), "1e-05");
  EXPECT_EQ(probabilityText(0.0, -402.3), "1e-402");
  EXPECT_EQ(probabilityText(experiments::kNone, experiments::kNone), "–");
}

}  // namespace
}  // namespace capstan::analysis
